#include "input/layouts/layouts.hpp"

#include "input/camera_file.hpp"
#include "input/layouts/image_folder.hpp"

namespace stdc {

std::optional<RgbdCameras> own_cameras(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "camera.yaml";
  if (!is_file(file)) return std::nullopt;
  return read_cameras(file);
}

Camera scaled_camera(const Camera& camera, cv::Size size) {
  Camera scaled = camera;
  const double x = static_cast<double>(size.width) / camera.width;
  const double y = static_cast<double>(size.height) / camera.height;
  scaled.width = size.width, scaled.height = size.height;
  scaled.fx *= x, scaled.fy *= y;
  // Pixel 0 has its middle at 0, half a pixel from the edge.
  scaled.cx = (camera.cx + 0.5) * x - 0.5, scaled.cy = (camera.cy + 0.5) * y - 0.5;
  return scaled;
}

double rate_of(const SourceOptions& options, double usual) { return options.rate.value_or(usual); }

}  // namespace stdc
