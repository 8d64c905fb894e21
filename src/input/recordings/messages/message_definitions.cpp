#include "input/recordings/messages/message_definitions.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

namespace stdc {
namespace {

struct Definition {
  std::string_view type, fields;
};

constexpr std::array kDefinitions{
    Definition{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    Definition{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    Definition{"std_msgs/String", "string data\n"},
    Definition{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    Definition{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    Definition{"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    Definition{"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    Definition{"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    Definition{"geometry_msgs/Transform",
               "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    Definition{"geometry_msgs/TransformStamped",
               "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    Definition{"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    Definition{"nav_msgs/Path", "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n"},
    Definition{"sensor_msgs/Imu",
               "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
               "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
               "float64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n"
               "float64[9] linear_acceleration_covariance\n"},
    Definition{"sensor_msgs/Image",
               "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\n"
               "uint32 step\nuint8[] data\n"},
    Definition{"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    Definition{"sensor_msgs/RegionOfInterest",
               "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n"},
    Definition{"sensor_msgs/CameraInfo",
               "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\n"
               "float64[9] k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\nuint32 binning_y\n"
               "sensor_msgs/RegionOfInterest roi\n"},
    Definition{"sensor_msgs/PointField", "string name\nuint32 offset\nuint8 datatype\nuint32 count\n"},
    Definition{"sensor_msgs/PointCloud2",
               "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
               "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n"},
};

const Definition& definition_of(std::string_view type) {
  const auto* found = std::find_if(kDefinitions.begin(), kDefinitions.end(),
                                   [&](const Definition& d) { return d.type == type; });
  if (found == kDefinitions.end()) throw std::invalid_argument("no definition of " + std::string(type));
  return *found;
}

/// Adds the types that the fields use, each once.
void collect_used_types(std::string_view fields, std::vector<std::string_view>& types) {
  while (!fields.empty()) {
    const std::string_view line = fields.substr(0, fields.find('\n'));
    fields.remove_prefix(line.size() + 1);
    const std::string_view type = line.substr(0, line.find_first_of(" ["));
    if (type.find('/') == std::string_view::npos) continue;
    if (std::find(types.begin(), types.end(), type) != types.end()) continue;
    types.push_back(type);
    collect_used_types(definition_of(type).fields, types);
  }
}

}  // namespace

std::string message_definition(std::string_view type) {
  std::string plain(type);
  if (const auto at = plain.find("/msg/"); at != std::string::npos) plain.erase(at, 4);
  const Definition& definition = definition_of(plain);
  std::vector<std::string_view> used;
  collect_used_types(definition.fields, used);
  std::string text(definition.fields);
  for (const std::string_view other : used) {
    text.append(80, '=').append("\nMSG: ").append(other).append("\n").append(definition_of(other).fields);
  }
  return text;
}

}  // namespace stdc
