#include "simulation/scene/room_materials.hpp"

#include "core/random.hpp"
#include "simulation/scene/surface_textures.hpp"

namespace stdc::simulation {
namespace {

class Adder {
 public:
  explicit Adder(World& world) : world_(world) {}

  Finish tiles(const cv::Mat& image, float tile, float infrared_return = 0.85F) {
    return {add(image, tile, 0, 40, infrared_return), {}};
  }
  Finish glossy(const cv::Mat& image, float tile, float gloss, float shininess, float infrared_return) {
    return {add(image, tile, gloss, shininess, infrared_return), {}};
  }
  /// One picture that fills the face it is put on.
  Finish picture(const cv::Mat& image, float gloss = 0, float infrared_return = 0.85F) {
    return {add(image, 1, gloss, 60, infrared_return), PictureArea{}};
  }
  PictureSet pictures(const PictureSheet& atlas, float gloss, float infrared_return) {
    return {add(atlas.image, 1, gloss, 60, infrared_return), atlas};
  }
  Finish emitting(const cv::Mat& image, float emission, float infrared_return) {
    const int material = add(image, 1, 0, 40, infrared_return);
    world_.materials[material].emission = emission;
    return {material, PictureArea{}};
  }

 private:
  int add(const cv::Mat& image, float tile, float gloss, float shininess, float infrared_return) {
    Material material;
    material.texture = static_cast<int>(world_.textures.size());
    material.tile = tile;
    material.gloss = gloss;
    material.shininess = shininess;
    material.infrared_return = infrared_return;
    world_.textures.emplace_back(image);
    world_.materials.push_back(material);
    return static_cast<int>(world_.materials.size()) - 1;
  }

  World& world_;
};

void add_building(RoomMaterials& m, Adder& add, Random& random) {
  const Paint wall = hue_paint(random.uniform(0.08, 0.18), random.uniform(0.03, 0.1), 0.88);
  m.floor = random.below(2) == 0 ? add.tiles(parquet_texture({176, 128, 82}, random.next()), 2.2F)
                                 : add.tiles(parquet_texture({142, 104, 74}, random.next()), 2.2F);
  m.rug = add.picture(rug_texture(hue_paint(random.uniform(), 0.65, 0.45), random.next()));
  m.wall = add.tiles(plaster_texture(wall, random.next()), 1.6F);
  m.brick = add.tiles(brick_texture({166, 88, 66}, random.next()), 1.28F);
  m.wainscot = add.tiles(wood_texture({150, 104, 66}, 6, random.next()), 0.9F);
  m.ceiling = add.tiles(ceiling_texture(random.next()), 1.25F);
  m.light_panel = add.emitting(plain_texture({250, 250, 245}, random.next()), 3.0F, 0.5F);
  m.window = add.emitting(outdoor_texture(random.next()), 1.3F, 0.0F);
  m.door = add.tiles(wood_texture({164, 122, 84}, 3, random.next()), 0.9F);
}

void add_furniture(RoomMaterials& m, Adder& add, Random& random) {
  m.desk_wood = add.tiles(wood_texture({206, 178, 138}, 1, random.next()), 0.8F);
  m.shelf_wood = add.tiles(wood_texture({132, 94, 62}, 1, random.next()), 0.7F);
  m.black_plastic = add.glossy(plain_texture({30, 30, 33}, random.next()), 0.3F, 0.10F, 30, 0.55F);
  m.grey_plastic = add.tiles(plain_texture({120, 122, 126}, random.next()), 0.3F);
  m.white_plastic = add.tiles(plain_texture({222, 220, 214}, random.next()), 0.3F);
  m.screen_frame = add.glossy(plain_texture({22, 22, 24}, random.next()), 0.3F, 0.25F, 80, 0.3F);
  m.metal = add.glossy(plain_texture({150, 152, 156}, random.next()), 0.3F, 0.3F, 40, 0.5F);
  m.paper_edge = add.tiles(fabric_texture({226, 220, 204}, random.next()), 0.05F);
  m.chair_cloth =
      add.tiles(fabric_texture(hue_paint(random.uniform(0.5, 0.7), 0.5, 0.35), random.next()), 0.18F);
  m.curtain = add.tiles(fabric_texture(hue_paint(random.uniform(), 0.35, 0.6), random.next()), 0.3F);
  m.keyboard = add.picture(keyboard_texture(random.next()));
  m.cable = add.tiles(plain_texture({24, 24, 26}, random.next()), 0.3F, 0.4F);
}

void add_objects(RoomMaterials& m, Adder& add, Random& random) {
  m.cardboard = add.picture(cardboard_texture(random.next()));
  m.leaf = add.picture(leaf_texture(random.next()), 0.05F);
  m.clay = add.tiles(plain_texture({172, 96, 66}, random.next()), 0.3F);
  m.soil = add.tiles(cork_texture(random.next()), 0.2F);
  m.cork = add.tiles(cork_texture(random.next()), 0.5F);
  m.whiteboard = add.picture(whiteboard_texture(random.next()), 0.08F);
  m.calendar = add.picture(calendar_texture(random.next()));
  m.clock = add.picture(clock_texture());
  m.white_glaze = add.glossy(plain_texture({236, 234, 228}, random.next()), 0.3F, 0.2F, 90, 0.8F);
  m.blue_glaze = add.glossy(plain_texture({36, 70, 140}, random.next()), 0.3F, 0.2F, 90, 0.75F);
  m.red_glaze = add.glossy(plain_texture({176, 36, 34}, random.next()), 0.3F, 0.2F, 90, 0.75F);
  m.glass = add.glossy(plain_texture({88, 112, 104}, random.next()), 0.3F, 0.4F, 120, 0.15F);
  m.yellow_paint = add.tiles(plain_texture({226, 186, 40}, random.next()), 0.3F);
  m.red_paint = add.tiles(plain_texture({190, 44, 40}, random.next()), 0.3F);
  m.green_paint = add.tiles(plain_texture({52, 130, 70}, random.next()), 0.3F);
  m.blue_paint = add.tiles(plain_texture({44, 84, 170}, random.next()), 0.3F);
}

void add_pictures(RoomMaterials& m, Adder& add, Random& random) {
  m.spines = add.pictures(book_spines(random.next()), 0, 0.8F);
  m.covers = add.pictures(book_covers(random.next()), 0.08F, 0.8F);
  m.pages = add.pictures(paper_pages(random.next()), 0, 0.9F);
  m.packages = add.pictures(packages(random.next()), 0.08F, 0.8F);
  m.screens = add.pictures(screens(random.next()), 0.15F, 0.45F);
  m.posters = add.pictures(posters(random.next()), 0, 0.9F);
  m.notes = add.pictures(small_prints(random.next()), 0, 0.9F);
}

}  // namespace

RoomMaterials add_room_materials(World& world, std::uint64_t seed) {
  RoomMaterials materials;
  Adder add(world);
  Random random(seed, 11);
  add_building(materials, add, random);
  add_furniture(materials, add, random);
  add_objects(materials, add, random);
  add_pictures(materials, add, random);
  return materials;
}

}  // namespace stdc::simulation
