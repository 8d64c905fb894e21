#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/rgbd_image.hpp"
#include "input/trajectory.hpp"
#include "slam/slam.hpp"
#include "viewer/server/web_address.hpp"
#include "viewer/view_state.hpp"

namespace stdc {

struct ViewOptions {
  WebAddress address;
};

/// Shows a run in a browser while it goes on: path, map, image, masks, curves.
///
///     ViewServer view({}, {.name = "my camera", .camera = camera});
///     puts(view.link().c_str());
///     for (...) view.show(&image, slam.track(image), slam);
///     slam.finish();
///     view.finish(slam);
///
/// The run does not care who looks: show() copies what pages want to see, at most every so often, and
/// returns; other threads make messages of it, and pages that cannot follow miss some. Nothing that it does
/// has an effect on the results. All calls come from the thread that calls the Slam; it never touches the
/// Slam outside them.
class ViewServer {
 public:
  /// Starts to serve the page. On an address that is not this machine's own the link has a token.
  /// Throws Error if the port is taken or the address cannot be listened on.
  ViewServer(const ViewOptions& options, ViewSubject subject);
  /// Ends all connections; pages keep what they have. After finish() they have up to two seconds to take what
  /// they lack.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Where to look: "http://localhost:8080/".
  std::string link() const;
  int port() const;
  /// Pages that look, now.
  int pages() const;

  /// A true trajectory to draw beside, as recorded; its world need not be the map's.
  void set_truth(Trajectory truth);
  /// Shows a frame, after its track() or skip(). If a page has paused the run this returns only when it is to
  /// go on, or when `give_up`, asked every so often, says so.
  /// @param image      null if it could not be read; copied if need be
  /// @param in_colour  gives the image again, in colour, if the run sees grey: called now and then by another
  ///                   thread, also later; what it throws leaves the image grey
  void show(const RgbdImage* image, const TrackingResult& result, const Slam& slam,
            const std::function<bool()>& give_up = {}, const std::function<cv::Mat()>& in_colour = {});
  /// Waits for a page to look, for a run that is to be seen from its first frame.
  void wait_for_page(const std::function<bool()>& give_up) const;
  /// Shows the final state, after Slam::finish(), and the last image if that is still to be shown.
  /// @param loops  that finish() has closed
  void finish(const Slam& slam, const std::vector<LoopReport>& loops = {});

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stdc
