#include "commands/places/place_recognition_evaluation.hpp"

#include <gtest/gtest.h>

#include "atlas/test_scene.hpp"

namespace stdc::app {
namespace {

TEST(PlaceRecognitionTest, FindsThePlaceThatWasLeftLongAgo) {
  const test::Scene room(0, true);
  PlaceRecognitionTest trial(room.camera, {.gap = 10});
  const auto look = [&](int frame, double timestamp, double x) {
    const Pose pose = test::camera_at(x, 0, 0);
    const cv::Mat depth(room.camera.height, room.camera.width, CV_32FC1, cv::Scalar(3));
    return trial.add(frame, {timestamp, room.render(pose), depth}, pose);
  };
  const PlaceAnswer first = look(0, 0, 0);
  EXPECT_FALSE(first.found);
  EXPECT_FALSE(first.verified);
  EXPECT_EQ(first.best_overlap, 0);
  EXPECT_FALSE(look(5, 5, 0.05).found) << "it has not been left";
  const PlaceAnswer again = look(20, 20, 0.1);
  ASSERT_TRUE(again.found);
  EXPECT_LE(*again.found, 5);
  EXPECT_GT(again.overlap, 0.8);
  EXPECT_GT(again.score, 0.05);
  EXPECT_TRUE(again.verified);
  EXPECT_LT(again.error_m, 0.02);
  EXPECT_LT(again.error_rad, 0.01);
  EXPECT_EQ(trial.answers().size(), 3U);
}

PlaceAnswer answer(double best_overlap, double overlap, double score) {
  PlaceAnswer a;
  a.best_overlap = best_overlap;
  a.found = 1;
  a.overlap = a.overlap_of_five = overlap;
  a.score = score;
  return a;
}

TEST(PlaceRecognitionTest, ScoresCountWhatThereWasToFind) {
  std::vector<PlaceAnswer> answers;
  answers.push_back(answer(0.9, 0.8, 0.5));   // right
  answers.push_back(answer(0.9, 0.05, 0.4));  // wrong, but a right one is among the first five
  answers.back().overlap_of_five = 0.7;
  answers.push_back(answer(0.2, 0.2, 0.6));  // hardly the same place: neither
  answers.push_back(answer(0.0, 0.0, 0.1));  // wrong, there was nothing to find
  answers.push_back(PlaceAnswer{});          // nothing to find, nothing found
  answers[0].verified = answers[3].verified = true;
  answers[0].error_m = 0.01;
  answers[3].error_m = 2;
  const PlaceScores scores = score_places(answers, {.overlap = 0.3});
  EXPECT_EQ(scores.views, 5);
  EXPECT_EQ(scores.possible, 2);
  EXPECT_EQ(scores.first_right, 1);
  EXPECT_EQ(scores.five_right, 2);
  EXPECT_DOUBLE_EQ(scores.first.recall_without_error.value(), 0.5);
  EXPECT_DOUBLE_EQ(scores.first.best_wrong_score.value(), 0.4);
  EXPECT_EQ(scores.verified_right, 1);
  EXPECT_EQ(scores.verified_wrong, 1);
  EXPECT_DOUBLE_EQ(scores.worst_error_m, 2);
}

}  // namespace
}  // namespace stdc::app
