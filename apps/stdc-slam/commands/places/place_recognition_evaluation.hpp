#pragma once

#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "core/rgbd_image.hpp"
#include "evaluation/precision_recall.hpp"
#include "features/extractor.hpp"
#include "place_recognition/place_index.hpp"

namespace stdc::app {

/// What decides whether places are recognised.
struct PlaceRecognitionTestSettings {
  double gap = 10;       ///< [s] a place must have been left for that long
  double overlap = 0.3;  ///< share of the view that an earlier view must show for there to be a place to find
};

/// What came of asking for the place of one view.
struct PlaceAnswer {
  int frame = 0;
  double best_overlap = 0;            ///< with the earlier view that shows most of it
  std::optional<int> found;           ///< frame of the first answer
  double score = 0;                   ///< of the first answer
  double overlap = 0;                 ///< with the first answer
  double overlap_of_five = 0;         ///< the best among the first five
  bool verified = false;              ///< one of the first three was taken for the same place
  double error_m = 0, error_rad = 0;  ///< of the pose by which it was
};

/// Recognises the places of a sequence with known poses: for each view what the place index says of the views
/// before, and what verification makes of it. Whether an answer is right is told by the poses and depths: how
/// many of the view's points lie on what the other one sees.
class PlaceRecognitionTest {
 public:
  PlaceRecognitionTest(const Camera& camera, const PlaceRecognitionTestSettings& settings);

  /// Asks for the place of the next view, then adds it.
  const PlaceAnswer& add(int frame, const RgbdImage& grey, const Pose& cam_from_world);

  const std::vector<PlaceAnswer>& answers() const { return answers_; }
  const std::vector<double>& query_ms() const { return query_ms_; }
  const std::vector<double>& verify_ms() const { return verify_ms_; }

  /// An answer is right if at least this share of the view is seen by it too.
  static constexpr double kRight = 0.1;

 private:
  struct View {
    int frame = 0;
    double timestamp = 0;
    KeyframeId keyframe;
    std::vector<Eigen::Vector3d> points;  ///< of the keypoints with depth, world [m]
    cv::Mat depth;                        ///< every eighth pixel [m], CV_32FC1
  };

  View make_view(int frame, const RgbdImage& grey, const Pose& cam_from_world);
  double overlap(const View& of, const View& with) const;
  void verify(const View& view, const std::vector<PlaceMatch>& places, PlaceAnswer& answer);

  Camera camera_;
  PlaceRecognitionTestSettings settings_;
  FeatureExtractor extractor_{FeatureSettings{}};
  Atlas atlas_;  ///< with true poses; each keyframe has landmarks of its own
  PlaceIndex index_;
  std::vector<View> views_;  ///< by keyframe id
  std::vector<PlaceAnswer> answers_;
  std::vector<double> query_ms_, verify_ms_;
};

/// Over all views.
struct PlaceScores {
  int views = 0;
  int possible = 0;                     ///< that see a place again
  int first_right = 0, five_right = 0;  ///< of those: right answers first, among the first five
  PrecisionRecall first;                ///< of the first answers, by score
  int verified_right = 0, verified_wrong = 0;
  double worst_error_m = 0, worst_error_rad = 0;  ///< of verified poses
};

/// A verified pose that is further off than 20 cm or 10 degrees is wrong. Right answers for views that see
/// only a little of a place again (between kRight and settings.overlap) are left out.
PlaceScores score_places(const std::vector<PlaceAnswer>& answers,
                         const PlaceRecognitionTestSettings& settings);

}  // namespace stdc::app
