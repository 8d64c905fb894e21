#include "commands/places/place_recognition_evaluation.hpp"

#include <algorithm>
#include <cmath>

#include "core/stopwatch.hpp"
#include "place_recognition/loop_verification.hpp"

namespace stdc::app {
namespace {

constexpr int kCoarse = 8;  // [px]
constexpr double kMaxErrorMetres = 0.2, kMaxErrorRadians = 0.175;

cv::Mat coarse_depth(const Camera& camera, const cv::Mat& depth) {
  cv::Mat coarse(camera.height / kCoarse, camera.width / kCoarse, CV_32FC1);
  for (int y = 0; y < coarse.rows; ++y) {
    for (int x = 0; x < coarse.cols; ++x) {
      coarse.at<float>(y, x) =
          depth_at(depth, camera.depth_units_per_metre, kCoarse * x + kCoarse / 2, kCoarse * y + kCoarse / 2);
    }
  }
  return coarse;
}

}  // namespace

PlaceRecognitionTest::PlaceRecognitionTest(const Camera& camera, const PlaceRecognitionTestSettings& settings)
    : camera_(camera), settings_(settings) {}

PlaceRecognitionTest::View PlaceRecognitionTest::make_view(int frame, const RgbdImage& grey,
                                                           const Pose& cam_from_world) {
  Features raw = extractor_.extract(grey.colour);
  const auto features = std::make_shared<const FrameFeatures>(camera_, std::move(raw), grey.depth,
                                                              extractor_.settings().scale_factor,
                                                              extractor_.levels(grey.colour.size()), nullptr);
  View view{frame, grey.timestamp, {}, {}, coarse_depth(camera_, grey.depth)};
  view.keyframe = atlas_.add_keyframe({frame, grey.timestamp, cam_from_world, CameraMotion(), features,
                                       measure_keypoints(camera_, CameraMotion(), *features)});
  const Pose world_from_cam = cam_from_world.inverse();
  for (int i = 0; i < features->size(); ++i) {
    if (features->depth(i) <= 0) continue;
    const Eigen::Vector3d point =
        world_from_cam * camera_.unproject(features->pixel(i).cast<double>(), features->depth(i));
    view.points.push_back(point);
    const LandmarkId landmark = atlas_.add_landmark(point, view.keyframe);
    atlas_.observe(view.keyframe, i, landmark);
    atlas_.refresh(landmark);
  }
  return view;
}

double PlaceRecognitionTest::overlap(const View& of, const View& with) const {
  if (of.points.empty()) return 0;
  const Pose& cam_from_world = atlas_.keyframe(with.keyframe).cam_from_world;
  int shared = 0;
  for (const Eigen::Vector3d& point : of.points) {
    const Eigen::Vector3d p = cam_from_world * point;
    if (p.z() < 0.1) continue;
    const Eigen::Vector2d pixel = camera_.distort(camera_.project(p)) / kCoarse;
    if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < with.depth.cols && pixel.y() < with.depth.rows))
      continue;
    const double z = with.depth.at<float>(static_cast<int>(pixel.y()), static_cast<int>(pixel.x()));
    shared += z > 0 && std::abs(z - p.z()) < 0.1 * p.z() + 0.05 ? 1 : 0;
  }
  return static_cast<double>(shared) / static_cast<double>(of.points.size());
}

const PlaceAnswer& PlaceRecognitionTest::add(int frame, const RgbdImage& grey, const Pose& cam_from_world) {
  View view = make_view(frame, grey, cam_from_world);
  PlaceAnswer answer;
  answer.frame = frame;
  std::vector<KeyframeId> recent;
  for (const View& other : views_) {
    if (view.timestamp - other.timestamp < settings_.gap) {
      recent.push_back(other.keyframe);
    } else {
      answer.best_overlap = std::max(answer.best_overlap, overlap(view, other));
    }
  }
  const FrameFeatures& features = *atlas_.keyframe(view.keyframe).features;
  const double start = thread_cpu_ms();
  const std::vector<PlaceMatch> places = index_.query(features.descriptors(), recent, 5);
  query_ms_.push_back(thread_cpu_ms() - start);
  for (std::size_t rank = 0; rank < places.size(); ++rank) {
    const View& place = views_[places[rank].keyframe.value];
    const double shared = overlap(view, place);
    answer.overlap_of_five = std::max(answer.overlap_of_five, shared);
    if (rank > 0) continue;
    answer.found = place.frame;
    answer.score = places[rank].score;
    answer.overlap = shared;
  }
  verify(view, places, answer);
  index_.add(view.keyframe, features.descriptors());
  views_.push_back(std::move(view));
  answers_.push_back(answer);
  return answers_.back();
}

void PlaceRecognitionTest::verify(const View& view, const std::vector<PlaceMatch>& places,
                                  PlaceAnswer& answer) {
  constexpr std::size_t kTried = 3;
  for (std::size_t rank = 0; rank < std::min(kTried, places.size()) && !answer.verified; ++rank) {
    const double start = thread_cpu_ms();
    const auto loop = verify_loop({{camera_, {}}, {}}, atlas_, view.keyframe, places[rank].keyframe, {});
    verify_ms_.push_back(thread_cpu_ms() - start);
    if (!loop) continue;
    const Pose& truth = atlas_.keyframe(view.keyframe).cam_from_world;
    answer.verified = true;
    answer.error_m = (loop->cam_from_world.centre() - truth.centre()).norm();
    answer.error_rad = loop->cam_from_world.rotation.angularDistance(truth.rotation);
  }
}

PlaceScores score_places(const std::vector<PlaceAnswer>& answers,
                         const PlaceRecognitionTestSettings& settings) {
  PlaceScores scores;
  std::vector<ScoredAnswer> first;
  for (const PlaceAnswer& answer : answers) {
    ++scores.views;
    const bool possible = answer.best_overlap >= settings.overlap;
    const bool right = answer.found && answer.overlap >= PlaceRecognitionTest::kRight;
    if (possible) {
      ++scores.possible;
      scores.first_right += right ? 1 : 0;
      scores.five_right += answer.overlap_of_five >= PlaceRecognitionTest::kRight ? 1 : 0;
    }
    if (answer.found && (possible || !right)) first.push_back({answer.score, right});
    if (!answer.verified) continue;
    scores.worst_error_m = std::max(scores.worst_error_m, answer.error_m);
    scores.worst_error_rad = std::max(scores.worst_error_rad, answer.error_rad);
    if (answer.error_m > kMaxErrorMetres || answer.error_rad > kMaxErrorRadians) {
      ++scores.verified_wrong;
    } else if (possible) {
      ++scores.verified_right;
    }
  }
  scores.first = precision_recall(std::move(first), scores.possible);
  return scores;
}

}  // namespace stdc::app
