#pragma once

#include <string>

namespace stdc {

// What the names of topics tell, by the habits of ROS drivers.

/// The camera as `convert` writes it (std_msgs/String, the text of a camera file): CameraInfo has no place
/// for the readout time of the rows and the rotation.
inline constexpr const char* kCameraFileTopic = "/stdc_slam/camera";

/// "/camera/color" of "/camera/color/image_raw/compressed", "/device_0/sensor_1/Color_0" of RealSense's
/// ".../Color_0/image/data".
std::string camera_of_topic(const std::string& topic);
/// How many names two cameras or topics share from the start on.
int shared_names(const std::string& a, const std::string& b);
/// Whether the images have been undistorted.
bool is_rectified(const std::string& topic);
/// Whether the driver has registered this depth to colour.
bool is_named_registered(const std::string& topic);
/// Whether it is infrared, which has 16 bits as depth may have.
bool is_named_infrared(const std::string& topic);
/// Whether it is made of a depth image, but no depth: confidence, disparity.
bool is_named_confidence(const std::string& topic);
/// Whether it is a picture for people, made of others.
bool is_named_visualisation(const std::string& topic);
/// Whether it gives true poses.
bool is_named_truth(const std::string& topic);
/// Of several topics of one camera that show the same picture, how good a name is.
int rank_of_name(const std::string& topic);

}  // namespace stdc
