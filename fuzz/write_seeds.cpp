// fuzz_seeds FOLDER: writes small valid images and maps for the fuzzers to start from.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include "atlas/storage/map_file.hpp"
#include "core/images/image_codec.hpp"
#include "core/random.hpp"
#include "input/depth_formats/test_depth_files.hpp"
#include "input/layouts/scannet/test_sens.hpp"
#include "input/recordings/messages/test_messages.hpp"

namespace {

cv::Mat picture(int type) {
  stdc::Random random(1);
  cv::Mat image(24, 40, type);
  const std::size_t row_bytes = image.elemSize() * 40;
  for (int y = 0; y < image.rows; ++y) {
    for (std::size_t i = 0; i < row_bytes; ++i) {
      image.ptr(y)[i] =
          static_cast<std::uint8_t>(4 * static_cast<int>(i) + static_cast<int>(random.below(16)));
    }
  }
  return image;
}

void write(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// Per map two keyframes that see the same three landmarks and are tied, with or without patches.
std::string small_map(int maps, bool patches) {
  const stdc::Camera camera{.width = 40, .height = 24};
  stdc::StoredFeatures stored;
  stored.keypoints.resize(4);
  stored.descriptors.resize(4);
  stored.pixels = {{3, 4}, {10, 12}, {30, 5}, {38, 20}};
  stored.depths = {1, 2, 0, 3};
  if (patches) stored.patches.resize(4);
  const auto features = std::make_shared<const stdc::FrameFeatures>(camera, std::move(stored));
  stdc::Atlas atlas;
  for (int frame = 0; frame < 2 * maps; ++frame) {
    const bool second = frame % 2 == 1;
    const stdc::KeyframeId id = atlas.add_keyframe({frame,
                                                    0.1 * frame,
                                                    stdc::Pose(),
                                                    stdc::CameraMotion(),
                                                    features,
                                                    stdc::measure_keypoints(camera, {}, *features),
                                                    {static_cast<std::uint32_t>(frame / 2)}});
    for (int i = 0; i < 3; ++i) {
      if (!second) atlas.add_landmark({0.1 * i, 0, 2}, id);
      atlas.observe(id, i, {static_cast<std::uint32_t>(3 * (frame / 2) + i)});
    }
    atlas.update_covisibility(id);
    if (second) atlas.add_loop_edge({id.value - 1}, id);
  }
  stdc::DenseViews views;  // of some maps
  if (maps > 1) {
    stdc::DenseView view;
    view.reference = {1};
    view.depth = {1, 2, 3}, view.support = {4}, view.colour = {5, 6};
    views.push_back(std::make_shared<const stdc::DenseView>(view));
  }
  std::ostringstream stream;
  stdc::write_map(stream, camera, atlas, views);
  return stream.str();
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  write(path, {text.begin(), text.end()});
}

/// Depth in other files than PNG, 7 x 5 pixels, and a .sens file.
void write_depth_files(const std::filesystem::path& folder) {
  using namespace stdc::test;
  std::filesystem::create_directories(folder / "depth_file");
  std::filesystem::create_directories(folder / "sens_file");
  const std::vector<float> metres(35, 1.5F);
  write_text(folder / "depth_file/f4.npy", make_npy<float>("<f4", "(5, 7)", metres));
  write_text(folder / "depth_file/u2.npy",
             make_npy<std::uint16_t>(">u2", "(5, 7, 1)", std::vector<std::uint16_t>(35, 7), true));
  write_text(folder / "depth_file/units.tiff", make_tiff(cv::Mat(5, 7, CV_16UC1, cv::Scalar(9)), false));
  write_text(folder / "depth_file/tiles.tiff", make_tiff(cv::Mat(5, 7, CV_32FC1, cv::Scalar(9)), true));
  write_text(folder / "depth_file/z.exr", make_exr(7, 5, "Z", metres));
  write_text(folder / "sens_file/three.sens", make_sens(3));
}

/// Messages of both serialisations behind the byte that tells which.
void write_messages(const std::filesystem::path& folder) {
  using stdc::test::MessageWriter;
  for (const auto style :
       {MessageWriter::Style::ros1, MessageWriter::Style::cdr_little, MessageWriter::Style::cdr_big}) {
    const auto put = [&](const char* name, const MessageWriter& message) {
      std::vector<std::uint8_t> bytes(1, message.is_ros1() ? 0 : 1);
      std::copy(message.bytes().begin(), message.bytes().end(), std::back_inserter(bytes));
      write(folder / (name + std::to_string(static_cast<int>(style))), bytes);
    };
    const std::vector<std::uint8_t> pixels(4 * 6 * 4, 77), png = stdc::encode_png(picture(CV_16UC1));
    for (const char* encoding : {"rgb8", "mono16", "32FC1", "yuv422", "bayer_rggb8"}) {
      put(encoding, stdc::test::image_message(style, 1, "f", 6, 4, encoding, pixels));
    }
    std::vector<std::uint8_t> depth(12);
    depth.insert(depth.end(), png.begin(), png.end());
    put("depth", MessageWriter(style).header(1, "f").text("16UC1; compressedDepth png").blob(depth));
    put("jpeg", MessageWriter(style)
                    .header(1, "f")
                    .text("bgr8; jpeg compressed bgr8")
                    .blob(stdc::encode_jpeg(picture(CV_8UC3), 30)));
    std::vector<std::uint8_t> rvl(12 + 8 + 16, 0x11);
    rvl[12] = 6, rvl[16] = 4, rvl[13] = rvl[14] = rvl[15] = rvl[17] = rvl[18] = rvl[19] = 0;
    put("rvl", MessageWriter(style).header(1, "f").text("16UC1; compressedDepth rvl").blob(rvl));
    put("info", stdc::test::camera_info_message(style, "f", stdc::Camera(), "plumb_bob", {0.1, 0, 0, 0, 0}));
    put("tf", stdc::test::transform_message(style, "a", "b", stdc::Pose()));
    put("odometry",
        MessageWriter(style).header(1, "f").text("b").pose(stdc::Pose()).doubles(std::vector<double>(84)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder / "colour_image");
  std::filesystem::create_directories(folder / "depth_image");
  write(folder / "colour_image/colour.png", stdc::encode_png(picture(CV_8UC3)));
  write(folder / "colour_image/grey.png", stdc::encode_png(picture(CV_8UC1)));
  write(folder / "colour_image/colour.jpg", stdc::encode_jpeg(picture(CV_8UC3)));
  write(folder / "colour_image/grey.jpg", stdc::encode_jpeg(picture(CV_8UC1), 50));
  write(folder / "depth_image/depth.png", stdc::encode_png(picture(CV_16UC1)));
  // What png_builder.hpp wraps: header bytes and filtered rows, here with each filter in turn.
  for (const auto& [target, bits, colour, pixel_bytes] :
       {std::tuple{"colour_image/rows_rgb", 8, 2, 3}, std::tuple{"colour_image/rows_grey", 8, 0, 1},
        std::tuple{"depth_image/rows", 16, 0, 2}}) {
    std::vector<std::uint8_t> rows{static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(colour), 0, 0,
                                   0};
    for (int y = 0; y < 24; ++y) {
      rows.push_back(static_cast<std::uint8_t>(y % 5));
      for (int i = 0; i < 40 * pixel_bytes; ++i) rows.push_back(static_cast<std::uint8_t>(i * y));
    }
    write(folder / target, rows);
  }
  std::filesystem::create_directories(folder / "ros_message");
  write_messages(folder / "ros_message");
  write_depth_files(folder);
  std::filesystem::create_directories(folder / "map_file");
  for (const bool patches : {false, true}) {
    const std::string bytes = small_map(1, patches);
    write(folder / "map_file" / (patches ? "patches.map" : "plain.map"), {bytes.begin(), bytes.end()});
  }
  const std::string atlas = small_map(3, false);
  write(folder / "map_file/atlas.atlas", {atlas.begin(), atlas.end()});
  return 0;
}
