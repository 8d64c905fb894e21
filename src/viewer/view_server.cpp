#include "viewer/view_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "viewer/keyframe_images.hpp"
#include "viewer/mesh_painter.hpp"
#include "viewer/pause_gate.hpp"
#include "viewer/server/local_addresses.hpp"
#include "viewer/server/web_server.hpp"
#include "viewer/view_painter.hpp"

namespace stdc {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kImageInterval = std::chrono::milliseconds(60);
constexpr auto kMinMapInterval = std::chrono::milliseconds(500);
constexpr int kMapShare = 100;  ///< copying the map takes at most a hundredth of the run's time
constexpr auto kGlance = std::chrono::milliseconds(50);

ViewAccess access_for(const WebAddress& address) {
  return ViewAccess(is_loopback(address.host) ? std::string() : make_view_token());
}

}  // namespace

class ViewServer::Impl {
 public:
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  Impl(const ViewOptions& options, ViewSubject subject)
      : address_(options.address),
        access_(access_for(options.address)),
        units_(subject.camera.depth_units_per_metre),
        can_pause_(subject.can_pause),
        painter_(std::move(subject), board_, keyframes_),
        mesh_(board_, [this](std::size_t triangles, double voxel) { painter_.set_mesh(triangles, voxel); }),
        web_(options.address, access_, board_,
             {[this](const ViewRequest& request) { obey(request); },
              [this](std::uint32_t frame) { return keyframes_.message(frame); }}) {}

  std::string link() const {
    const std::string host = is_loopback(address_.host) ? "localhost" : reachable_name(address_.host);
    const std::string token = access_.token().empty() ? "" : "?token=" + access_.token();
    return fmt::format("http://{}:{}/{}", host, web_.port(), token);
  }
  const WebServer& web() const { return web_; }
  ViewPainter& painter() { return painter_; }

  void show(const RgbdImage* image, const TrackingResult& result, const Slam& slam,
            const std::function<cv::Mat()>& in_colour) {
    painter_.add(result);
    const bool has_image = image != nullptr && !image->colour.empty();
    if (result.is_keyframe && has_image)
      painter_.give_keyframe(result.frame, {image->colour.clone(), in_colour});
    if (web_.wanted() == 0) {
      skipped_.reset();
      return;
    }
    if (has_image) show_image(*image, result.frame, slam, in_colour, false);
    show_map(slam, false);
    show_mesh(slam);
  }

  void hold(const RgbdImage* image, const TrackingResult& result, const Slam& slam,
            const std::function<bool()>& give_up, const std::function<cv::Mat()>& in_colour) {
    if (!gate_.hold_after_frame()) return;
    painter_.set_paused(true);
    const bool has_image = image != nullptr && !image->colour.empty();
    // What was left out for want of time, and what pages that come now have not seen.
    std::uint32_t shown = 0;
    int connections = -1;
    while (!gate_.wait(kGlance)) {
      if (give_up && give_up()) break;
      const std::uint32_t wanted = web_.wanted();
      if (wanted == shown && web_.connections() == connections) {
        if (wanted != 0) show_mesh(slam);
        continue;
      }
      shown = wanted;
      connections = web_.connections();
      if (wanted == 0) continue;
      if (has_image) show_image(*image, result.frame, slam, in_colour, true);
      show_map(slam, true);
    }
    painter_.set_paused(gate_.paused());
  }

  void finish(const Slam& slam) {
    finished_ = true;
    if (skipped_ && (web_.wanted() & kWantImage) != 0)
      painter_.give(*std::exchange(skipped_, {}), web_.wanted());
    if (web_.clients() > 0) {
      show_map(slam, true);
      if ((web_.wanted() & kWantMesh) != 0) mesh_.give(slam.dense_so_far());
    }
    painter_.finish();
  }

  /// Gives pages the time to take the final state.
  ~Impl() {
    if (!finished_) return;
    constexpr auto kMax = std::chrono::seconds(2);
    const auto end = Clock::now() + kMax;
    painter_.drain(kMax);
    web_.wait_until_up_to_date(std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()));
  }

 private:
  void obey(const ViewRequest& request) {
    if (!can_pause_) return;
    if (request.kind == ViewRequest::Kind::pause) gate_.pause();
    if (request.kind == ViewRequest::Kind::resume) gate_.resume();
    if (request.kind == ViewRequest::Kind::step) gate_.step();
  }

  void show_image(const RgbdImage& image, int frame, const Slam& slam,
                  const std::function<cv::Mat()>& in_colour, bool now) {
    const std::uint32_t wanted = web_.wanted();
    skipped_.reset();
    if ((wanted & kWantImage) == 0) return;
    ViewImage view;
    view.frame = frame;
    view.depth_units_per_metre = units_;
    view.found = slam.last_frame();
    view.colour = {image.lasting(image.colour), in_colour};  // the caller may have other uses for its buffers
    if ((wanted & kWantDepth) != 0) view.depth = image.lasting(image.depth);
    if (!now && (Clock::now() < next_image_ || !painter_.free_for_image())) {
      skipped_ = std::move(view);
      return;
    }
    next_image_ = Clock::now() + kImageInterval;
    painter_.give(std::move(view), wanted);
  }

  void show_map(const Slam& slam, bool now) {
    if ((web_.wanted() & kWantMap) == 0 && !now) return;
    if (!slam.active_map().valid()) return;
    if (!now && (Clock::now() < next_map_ || !painter_.free_for_map())) return;
    const auto begin = Clock::now();
    painter_.give(ViewMap{slam.active_map(), slam.snapshot(), slam.trajectory(), {}});
    const Clock::duration cost = Clock::now() - begin;
    next_map_ = begin + std::max<Clock::duration>(kMinMapInterval, kMapShare * cost);
  }

  void show_mesh(const Slam& slam) {
    if ((web_.wanted() & kWantMesh) == 0 || !slam.active_map().valid() || !mesh_.due()) return;
    if (Slam::DenseSoFar dense = slam.dense_so_far(); !dense.empty()) mesh_.give(std::move(dense));
  }

  WebAddress address_;
  ViewAccess access_;
  double units_;
  bool can_pause_;
  bool finished_ = false;
  Clock::time_point next_image_{}, next_map_{};
  std::optional<ViewImage> skipped_;  ///< the latest image if pages have not been given it
  PauseGate gate_;
  KeyframeImages keyframes_;
  ViewBoard board_;
  ViewPainter painter_;
  MeshPainter mesh_;
  WebServer web_;  ///< last: it ends first
};

ViewServer::ViewServer(const ViewOptions& options, ViewSubject subject)
    : impl_(std::make_unique<Impl>(options, std::move(subject))) {}

ViewServer::~ViewServer() = default;

std::string ViewServer::link() const { return impl_->link(); }
int ViewServer::port() const { return impl_->web().port(); }
int ViewServer::pages() const { return impl_->web().clients(); }
void ViewServer::set_truth(Trajectory truth) { impl_->painter().set_truth(std::move(truth)); }

void ViewServer::show(const RgbdImage* image, const TrackingResult& result, const Slam& slam,
                      const std::function<bool()>& give_up, const std::function<cv::Mat()>& in_colour) {
  impl_->show(image, result, slam, in_colour);
  impl_->hold(image, result, slam, give_up, in_colour);
}

void ViewServer::wait_for_page(const std::function<bool()>& give_up) const {
  while (!impl_->web().wait_until_wanted(kGlance) && !(give_up && give_up())) {
  }
}

void ViewServer::finish(const Slam& slam, const std::vector<LoopReport>& loops) {
  for (const LoopReport& loop : loops) impl_->painter().add(loop);
  impl_->finish(slam);
}

}  // namespace stdc
