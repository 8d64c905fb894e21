#include "simulation/light/ray_renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace stdc::simulation {
namespace {

using Eigen::Vector3f;

constexpr int kPacket = RayScene::kPacket;
constexpr int kEdgeSamples = 4, kEdgesAtOnce = kPacket / kEdgeSamples;
constexpr float kClip = 1.2F;
constexpr int kBlockWidth = 4, kBlockHeight = kPacket / kBlockWidth;

/// The nearest hit of a ray, in the static scene or on a moving object.
struct Seen {
  Hit hit;
  bool moving = false;
};

/// From where some rows are seen.
struct Eye {
  Eigen::Matrix3f rotation;
  Vector3f origin;
};

/// One frame being rendered.
class FrameRender {
 public:
  FrameRender(const RayGrid& rays, const RayScene& scene, const SurfaceShader& shader,
              const std::function<Pose(double row)>& world_from_cam, const MovingObjects* moving)
      : rays_(rays),
        scene_(scene),
        shader_(shader),
        moving_(moving),
        seen_(static_cast<std::size_t>(rays.width()) * rays.height()) {
    const cv::Size size(rays.width(), rays.height());
    image_.colour.create(size, CV_32FC3);
    image_.depth.create(size, CV_32FC1);
    image_.infrared.create(size, CV_32FC1);
    image_.mask.create(size, CV_8UC1);
    image_.moved.create(size, CV_8UC1);
    for (int y = 0; y < rays.height(); y += kBlockHeight) {
      const Pose pose = world_from_cam(std::min(y + 0.5 * (kBlockHeight - 1), rays.height() - 1.0));
      eyes_.push_back({pose.rotation_matrix().cast<float>(), pose.translation.cast<float>()});
    }
  }

  IdealImage run() {
    for (int y = 0; y < rays_.height(); y += kBlockHeight) {
      for (int x = 0; x < rays_.width(); x += kBlockWidth) cast_block(x, y);
    }
    for (int y = 0; y < rays_.height(); ++y) {
      for (int x = 0; x < rays_.width(); ++x) shade_pixel(x, y);
    }
    std::vector<cv::Point> edges;
    for (int y = 0; y < rays_.height(); ++y) {
      for (int x = 0; x < rays_.width(); ++x) {
        if (on_edge(x, y)) edges.emplace_back(x, y);
      }
    }
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
      // Pixels that are seen from the same place.
      while (end < edges.size() && end - i < kEdgesAtOnce &&
             edges[end].y / kBlockHeight == edges[i].y / kBlockHeight) {
        ++end;
      }
      smooth(&edges[i], static_cast<int>(end - i));
    }
    return std::move(image_);
  }

 private:
  const Eye& eye_of(int y) const { return eyes_[static_cast<std::size_t>(y / kBlockHeight)]; }

  static Vector3f direction(const Eye& eye, const Eigen::Vector2f& ray) {
    return eye.rotation.col(0) * ray.x() + eye.rotation.col(1) * ray.y() + eye.rotation.col(2);
  }

  void trace(const Vector3f& origin, const Vector3f* directions, int count, Seen* seen) const {
    std::array<Hit, kPacket> hits;
    scene_.trace(origin, directions, count, hits.data());
    for (int i = 0; i < count; ++i) seen[i] = {hits[i], false};
    if (moving_ == nullptr || !moving_->trace(origin, directions, count, hits.data())) return;
    for (int i = 0; i < count; ++i) {
      if (hits[i].quad != seen[i].hit.quad || hits[i].distance != seen[i].hit.distance)
        seen[i] = {hits[i], true};
    }
  }

  void cast_block(int x0, int y0) {
    std::array<Vector3f, kPacket> directions;
    std::array<Seen, kPacket> seen;
    std::array<std::size_t, kPacket> places{};
    int count = 0;
    for (int y = y0; y < std::min(y0 + kBlockHeight, rays_.height()); ++y) {
      for (int x = x0; x < std::min(x0 + kBlockWidth, rays_.width()); ++x) {
        places[count] = static_cast<std::size_t>(y) * rays_.width() + x;
        directions[count++] = direction(eye_of(y0), rays_.at(x, y));
      }
    }
    trace(eye_of(y0).origin, directions.data(), count, seen.data());
    for (int i = 0; i < count; ++i) seen_[places[i]] = seen[i];
  }

  Shade shade(const Seen& seen, const Vector3f& origin, const Vector3f& direction) const {
    if (!seen.hit.valid()) return {};
    if (seen.moving) return moving_->shade(seen.hit, origin, direction, rays_.pixel_angle());
    float shadow = 1;
    if (moving_ != nullptr) {
      shadow = moving_->shadow(origin + seen.hit.distance * direction, shader_.normal(seen.hit, direction));
    }
    return shader_.shade(seen.hit, origin, direction, rays_.pixel_angle(), shadow);
  }

  const Seen& at(int x, int y) const { return seen_[static_cast<std::size_t>(y) * rays_.width() + x]; }

  void shade_pixel(int x, int y) {
    const Seen& seen = at(x, y);
    const Eye& eye = eye_of(y);
    const Shade s = shade(seen, eye.origin, direction(eye, rays_.at(x, y)));
    image_.colour.at<cv::Vec3f>(y, x) = {s.colour.x(), s.colour.y(), s.colour.z()};
    image_.depth.at<float>(y, x) = seen.hit.valid() ? seen.hit.distance : 0;
    image_.infrared.at<float>(y, x) = s.infrared;
    image_.mask.at<std::uint8_t>(y, x) = seen.moving && moving_->dynamic(seen.hit) ? 255 : 0;
    image_.moved.at<std::uint8_t>(y, x) = seen.moving && moving_->ever_dynamic(seen.hit) ? 255 : 0;
  }

  bool differ(const Seen& a, const Seen& b) const {
    if (a.hit.quad == b.hit.quad && a.moving == b.moving) return false;
    if (a.moving != b.moving || !a.hit.valid() || !b.hit.valid()) return true;
    const float jump = std::abs(a.hit.distance - b.hit.distance) / std::min(a.hit.distance, b.hit.distance);
    if (jump > 0.05F) return true;
    if (a.moving) return moving_->surface(a.hit) != moving_->surface(b.hit);
    return shader_.surfaces_differ(a.hit, b.hit);
  }

  bool on_edge(int x, int y) const {
    const Seen& here = at(x, y);
    return (x > 0 && differ(here, at(x - 1, y))) || (x + 1 < rays_.width() && differ(here, at(x + 1, y))) ||
           (y > 0 && differ(here, at(x, y - 1))) || (y + 1 < rays_.height() && differ(here, at(x, y + 1)));
  }

  /// Antialiases up to kEdgesAtOnce pixels, seen from the same place: their colours become means over their
  /// areas.
  void smooth(const cv::Point* pixels, int count) {
    // The rotated grid: no two samples share a row or a column.
    static constexpr std::array<std::array<float, 2>, kEdgeSamples> kOffsets{
        {{-0.125F, -0.375F}, {0.375F, -0.125F}, {0.125F, 0.375F}, {-0.375F, 0.125F}}};
    const Eye& eye = eye_of(pixels[0].y);
    std::array<Vector3f, kPacket> directions;
    std::array<Seen, kPacket> seen;
    for (int i = 0; i < count * kEdgeSamples; ++i) {
      const cv::Point& p = pixels[i / kEdgeSamples];
      const auto& offset = kOffsets[i % kEdgeSamples];
      directions[i] = direction(eye, rays_.at(p.x, p.y, offset[0], offset[1]));
    }
    trace(eye.origin, directions.data(), count * kEdgeSamples, seen.data());
    for (int k = 0; k < count; ++k) {
      auto& colour = image_.colour.at<cv::Vec3f>(pixels[k]);
      // Clipped before the mean: else the edge of a lamp would stay jagged.
      const Rgb own = Rgb(colour[0], colour[1], colour[2]).cwiseMin(kClip);
      const Seen& centre = at(pixels[k].x, pixels[k].y);
      Rgb sum = own;
      for (int i = k * kEdgeSamples; i < (k + 1) * kEdgeSamples; ++i) {
        // The filtered texture varies little within a pixel: on the same quad the colour of the centre is
        // used.
        const bool known = seen[i].hit.quad == centre.hit.quad && seen[i].moving == centre.moving;
        sum += known ? own : Rgb(shade(seen[i], eye.origin, directions[i]).colour.cwiseMin(kClip));
      }
      sum /= 1 + kEdgeSamples;
      colour = {sum.x(), sum.y(), sum.z()};
    }
  }

  const RayGrid& rays_;
  const RayScene& scene_;
  const SurfaceShader& shader_;
  const MovingObjects* moving_;
  std::vector<Eye> eyes_;  ///< per kBlockHeight rows
  std::vector<Seen> seen_;
  IdealImage image_;
};

}  // namespace

IdealImage RayRenderer::render(const Pose& world_from_cam, const MovingObjects* moving) const {
  return render_rows([&](double /*row*/) { return world_from_cam; }, moving);
}

IdealImage RayRenderer::render_rows(const std::function<Pose(double row)>& world_from_cam,
                                    const MovingObjects* moving) const {
  return FrameRender(rays_, scene_, shader_, world_from_cam, moving).run();
}

}  // namespace stdc::simulation
