#pragma once

#include <functional>
#include <optional>
#include <string>

#include "run/frame_observer.hpp"
#include "run/interrupt_watch.hpp"
#include "run/sequence_input.hpp"
#include "slam/settings.hpp"
#include "viewer/view_server.hpp"

namespace stdc::app {

struct LiveViewOptions {
  std::optional<int> port;             ///< nothing: no view
  std::optional<std::string> address;  ///< nothing: for this machine alone
  bool wait = false;                   ///< begin when somebody looks
};

/// The page of `--view`: shows each frame, and holds a run where the page says so.
class LiveView : public FrameObserver {
 public:
  /// Starts to serve, and says on stderr where. Throws Error if the port is taken.
  /// @param slam_settings  for what there will be to see
  /// @param realtime       frames do not wait: there is no pause
  /// What is given must outlive this.
  LiveView(const LiveViewOptions& options, const SequenceInput& input, const Settings& slam_settings,
           bool realtime, bool quiet, const InterruptWatch& interrupts);

  /// Before the first frame; waits for a page if it is to.
  /// @param slam  whose frames they are: asked at each frame, as a robot may begin anew
  void begin(std::function<const Slam&()> slam);
  void on_frame(const ObservedFrame& frame) override;
  void on_end(const std::vector<LoopReport>& loops) override;

 private:
  const LiveViewOptions options_;
  const InterruptWatch& interrupts_;
  std::function<const Slam&()> slam_;
  ViewServer server_;
};

}  // namespace stdc::app
