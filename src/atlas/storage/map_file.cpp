#include "atlas/storage/map_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>

#include "atlas/connect_map.hpp"
#include "atlas/storage/keyframe_record.hpp"
#include "atlas/storage/record_stream.hpp"
#include "core/files/whole_file.hpp"

namespace stdc {
namespace {

constexpr std::array<char, 8> kMagic{'S', 'T', 'D', 'C', '-', 'M', 'A', 'P'};
constexpr std::size_t kLandmarksPerRecord = 4096;

void put_camera(RecordWriter& out, const Camera& camera) {
  out.put(static_cast<std::int32_t>(camera.width));
  out.put(static_cast<std::int32_t>(camera.height));
  for (const double value : {camera.fx, camera.fy, camera.cx, camera.cy, camera.k1, camera.k2, camera.p1,
                             camera.p2, camera.k3, camera.depth_units_per_metre, camera.frames_per_second,
                             camera.readout_time, camera.k4, camera.k5, camera.k6}) {
    out.put(value);
  }
  out.put(static_cast<std::int32_t>(camera.lens));
}

Camera get_camera(RecordReader& in, std::uint32_t version) {
  constexpr double kMaxValue = 1e6;
  Camera camera;
  camera.width = in.get_number<std::int32_t>(1, 16384);
  camera.height = in.get_number<std::int32_t>(1, 16384);
  for (double* value : {&camera.fx, &camera.fy}) *value = in.get_number<double>(1e-3, kMaxValue);
  for (double* value : {&camera.cx, &camera.cy, &camera.k1, &camera.k2, &camera.p1, &camera.p2, &camera.k3}) {
    *value = in.get_number<double>(-kMaxValue, kMaxValue);
  }
  for (double* value : {&camera.depth_units_per_metre, &camera.frames_per_second}) {
    *value = in.get_number<double>(1e-6, 1e9);
  }
  camera.readout_time = in.get_number<double>(0, 10);
  if (version < 2) return camera;
  for (double* value : {&camera.k4, &camera.k5, &camera.k6})
    *value = in.get_number<double>(-kMaxValue, kMaxValue);
  camera.lens =
      static_cast<LensModel>(in.get_number<std::int32_t>(static_cast<std::int32_t>(LensModel::brown_conrady),
                                                         static_cast<std::int32_t>(LensModel::equidistant)));
  return camera;
}

void put_landmark(RecordWriter& out, const Landmark& landmark, const NewIds& ids) {
  for (const double value : landmark.position) out.put(value);
  out.put_bytes(landmark.descriptor.bits.data(), sizeof(Descriptor::bits));
  for (const float value : landmark.direction) out.put(value);
  out.put(landmark.min_distance);
  out.put(landmark.max_distance);
  out.put(ids.keyframes[landmark.created_by.value]);
  out.put(static_cast<std::int32_t>(landmark.visible));
  out.put(static_cast<std::int32_t>(landmark.found));
}
constexpr std::size_t kLandmarkBytes = 3 * 8 + 32 + 3 * 4 + 2 * 4 + 4 + 2 * 4;

Landmark get_landmark(RecordReader& in, LandmarkId id) {
  Landmark landmark;
  landmark.id = id;
  for (double& value : landmark.position) value = in.get_number<double>(-1e9, 1e9);
  in.get_bytes(landmark.descriptor.bits.data(), sizeof(Descriptor::bits));
  for (float& value : landmark.direction) value = in.get_number<float>(-1.1F, 1.1F);
  landmark.min_distance = in.get_number<float>(0, 1e9F);
  landmark.max_distance = in.get_number<float>(0, 1e9F);
  landmark.created_by = {in.get<std::uint32_t>()};
  landmark.visible = in.get<std::int32_t>();
  landmark.found = in.get<std::int32_t>();
  return landmark;
}

/// Keyframes and landmarks in their order, without gaps. A keyframe that is gone has the number of the next
/// one that is not (for `created_by`); a landmark that nobody sees has none. Maps in the order of their
/// roots; those that were joined to others have none.
NewIds number_anew(const Atlas& atlas) {
  NewIds ids;
  ids.maps.assign(atlas.map_count(), -1);
  int maps = 0;
  for (const KeyframeId id : atlas.keyframe_ids()) {
    const MapId map = atlas.keyframe(id).map;
    if (atlas.root(map) == id) ids.maps[map.value] = maps++;
  }
  const auto keyframes = static_cast<std::uint32_t>(atlas.keyframe_count());
  std::uint32_t next = 0;
  for (std::uint32_t id = 0; id < atlas.keyframe_id_limit(); ++id) {
    ids.keyframes.push_back(std::min(next, keyframes - 1));
    if (atlas.has(KeyframeId{id})) ++next;
  }
  next = 0;
  for (std::uint32_t id = 0; id < atlas.landmark_id_limit(); ++id) {
    const bool kept = atlas.has(LandmarkId{id}) && !atlas.landmark({id}).observations.empty();
    ids.landmarks.push_back(kept ? next++ : LandmarkId::kNone);
  }
  return ids;
}

void write_landmarks(std::ostream& stream, const Atlas& atlas, const NewIds& ids) {
  std::vector<LandmarkId> kept = atlas.landmark_ids();
  std::erase_if(kept, [&](LandmarkId id) { return ids.landmarks[id.value] == LandmarkId::kNone; });
  RecordWriter out;
  for (std::size_t first = 0; first < kept.size(); first += kLandmarksPerRecord) {
    const std::size_t count = std::min(kLandmarksPerRecord, kept.size() - first);
    out.put(static_cast<std::uint32_t>(count));
    for (std::size_t i = first; i < first + count; ++i) put_landmark(out, atlas.landmark(kept[i]), ids);
    out.finish(stream, "LAND");
  }
}

void put_image(RecordWriter& out, const std::vector<std::uint8_t>& bytes) {
  out.put(static_cast<std::uint32_t>(bytes.size()));
  out.put_bytes(bytes.data(), bytes.size());
}

std::vector<std::uint8_t> get_image(RecordReader& in) {
  std::vector<std::uint8_t> bytes(in.get_count(1));
  in.get_bytes(bytes.data(), bytes.size());
  return bytes;
}

void write_views(std::ostream& stream, const Atlas& atlas, const NewIds& ids, const DenseViews& views) {
  RecordWriter out;
  for (const auto& view : views) {
    const Atlas::KeptAncestor kept = atlas.resolve(view->reference);
    out.put(ids.keyframes[kept.keyframe.value]);
    put_pose(out, view->cam_from_reference * kept.cam_from_ancestor);
    out.put(static_cast<std::int32_t>(view->frame));
    out.put(view->timestamp);
    for (const auto* image : {&view->depth, &view->support, &view->colour}) put_image(out, *image);
    out.finish(stream, "VIEW");
  }
}

std::shared_ptr<const DenseView> get_view(RecordReader& in, std::size_t keyframes) {
  auto view = std::make_shared<DenseView>();
  view->reference = {in.get_number<std::uint32_t>(0, KeyframeId::kNone - 1)};
  in.check(view->reference.value < keyframes, "a view belongs to no keyframe");
  view->cam_from_reference = get_pose(in);
  view->frame = in.get<std::int32_t>();
  view->timestamp = in.get_number<double>(-1e12, 1e12);
  for (auto* image : {&view->depth, &view->support, &view->colour}) *image = get_image(in);
  return view;
}

std::uint32_t read_header(RecordReader& in, const std::string& name) {
  std::array<char, 16> head{};
  const bool whole = in.read_plain(head.data(), head.size());
  if (!whole || std::memcmp(head.data(), kMagic.data(), kMagic.size()) != 0) {
    throw Error(name, "is not a map file", "give one that was written by --save-map");
  }
  std::uint32_t version = 0, sum = 0;
  std::memcpy(&version, head.data() + 8, 4);
  std::memcpy(&sum, head.data() + 12, 4);
  in.check(check_sum(head.data(), 12) == sum, "a check sum is wrong");
  if (version > kMapFileVersion) {
    throw Error(name,
                fmt::format("is a map of version {}, this program reads up to {}", version, kMapFileVersion),
                "use a newer program, or make the map again");
  }
  in.check(version >= 1, "its version does not exist");
  return version;
}

}  // namespace

void write_map(std::ostream& stream, const Camera& camera, const Atlas& atlas, const DenseViews& views) {
  constexpr std::uint32_t kWithoutViews = 2;
  const std::uint32_t version = views.empty() ? kWithoutViews : kMapFileVersion;
  std::array<char, 16> head{};
  std::memcpy(head.data(), kMagic.data(), kMagic.size());
  std::memcpy(head.data() + 8, &version, 4);
  const std::uint32_t sum = check_sum(head.data(), 12);
  std::memcpy(head.data() + 12, &sum, 4);
  stream.write(head.data(), head.size());
  RecordWriter out;
  put_camera(out, camera);
  out.finish(stream, "CAMR");
  const NewIds ids = number_anew(atlas);
  for (const KeyframeId id : atlas.keyframe_ids()) {
    put_keyframe(out, atlas.keyframe(id), ids);
    out.finish(stream, "KEYF");
  }
  write_landmarks(stream, atlas, ids);
  write_views(stream, atlas, ids, views);
  out.put(static_cast<std::uint32_t>(atlas.keyframe_count()));
  out.finish(stream, "ENDM");
}

StoredMap read_map(std::istream& stream, const std::string& name) {
  RecordReader in(stream, name);
  const std::uint32_t version = read_header(in, name);
  in.next();
  in.check(in.tag() == "CAMR", "the camera is missing");
  const Camera camera = get_camera(in, version);
  in.expect_end();
  std::vector<Keyframe> keyframes;
  std::vector<Landmark> landmarks;
  DenseViews views;
  for (in.next(); in.tag() != "ENDM"; in.next()) {
    if (in.tag() == "KEYF") {
      keyframes.push_back(get_keyframe(in, camera, {static_cast<std::uint32_t>(keyframes.size())}));
    } else if (in.tag() == "VIEW" && version >= 3) {
      views.push_back(get_view(in, keyframes.size()));
    } else {
      in.check(in.tag() == "LAND", "a record is of no known kind");
      const std::size_t count = in.get_count(kLandmarkBytes);
      for (std::size_t i = 0; i < count; ++i) {
        landmarks.push_back(get_landmark(in, {static_cast<std::uint32_t>(landmarks.size())}));
      }
    }
    in.expect_end();
  }
  in.check(in.get<std::uint32_t>() == keyframes.size(), "a keyframe is missing");
  in.expect_end();
  in.check(stream.peek() == std::istream::traits_type::eof(), "something follows its end");
  connect_map(in, keyframes, landmarks);
  return {camera, Atlas(std::move(keyframes), std::move(landmarks)), version, std::move(views)};
}

void save_map(const std::filesystem::path& path, const Camera& camera, const Atlas& atlas,
              const DenseViews& views) {
  WholeFile file(path);
  write_map(file.stream(), camera, atlas, views);
  file.commit();
}

StoredMap load_map(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error(path.string(), "is a folder, not a map file", "give the file that --save-map wrote");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw Error(path.string(), fmt::format("cannot be opened ({})", std::strerror(errno)),
                "check the name; maps are written by --save-map");
  }
  return read_map(stream, path.string());
}

}  // namespace stdc
