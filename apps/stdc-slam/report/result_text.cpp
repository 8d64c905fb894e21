#include "report/result_text.hpp"

namespace stdc::app {

const char* status_name(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::initialising:
      return "initialising";
    case TrackingStatus::ok:
      return "ok";
    case TrackingStatus::uncertain:
      return "uncertain";
    case TrackingStatus::lost:
      return "lost";
    case TrackingStatus::skipped:
      return "skipped";
  }
  return "?";
}

}  // namespace stdc::app
