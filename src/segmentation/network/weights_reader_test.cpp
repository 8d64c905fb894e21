#include "segmentation/network/weights_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/files/test_folder.hpp"
#include "segmentation/network/test_random_weights.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::RandomWeights;

RandomWeights narrow(bool stdc2 = false) {
  return RandomWeights(stdc2, {{4, 8}, {16, 16, 32}, 8, 16, 4, 8, 2});
}

void expect_file_refused(const RandomWeights& weights, const std::string& part) {
  const std::string message = message_of([&] { weights.read(); });
  EXPECT_NE(message.find(part), std::string::npos) << "'" << message << "' has no '" << part << "'";
  EXPECT_EQ(message.rfind("random weights", 0), 0U) << message;
}

TEST(WeightsReader, ReadsBothArchitectures) {
  for (const bool stdc2 : {false, true}) {
    const NetworkWeights network = narrow(stdc2).read();
    EXPECT_EQ(network.architecture, stdc2 ? "STDC2-Seg" : "STDC1-Seg");
    EXPECT_EQ(network.stages[0].size(), stdc2 ? 4U : 2U);
    EXPECT_EQ(network.stages[1].size(), stdc2 ? 5U : 2U);
    EXPECT_EQ(network.stages[2].size(), stdc2 ? 3U : 2U);
    EXPECT_EQ(network.stages[2][0].stride(), 2);
    EXPECT_EQ(network.stages[2][1].stride(), 1);
    EXPECT_EQ(network.stages[2][1].inputs(), 32);
    EXPECT_EQ(network.input_size, cv::Size(512, 384));
    EXPECT_EQ(network.dynamic_classes, (std::vector<bool>{false, true}));
    EXPECT_FLOAT_EQ(network.mean[0], 0.485F);
    EXPECT_TRUE(network.calibrated());
  }
}

TEST(WeightsReader, FoldsBatchNormalisation) {
  const RandomWeights weights = narrow();
  const auto value = [&](const std::string& tensor) {
    return static_cast<double>(weights.tensors.at(tensor).values[1]);
  };
  const NetworkWeights network = weights.read();
  const std::string name = "backbone.stage3.0.blocks.0.";
  const ConvolutionWeights& layer = network.stages[0][0].blocks[0];
  const double factor = value(name + "bn.weight") / std::sqrt(value(name + "bn.running_var") + 1e-5);
  EXPECT_NEAR(layer.bias[1], value(name + "bn.bias") - value(name + "bn.running_mean") * factor, 1e-6);
  EXPECT_NEAR(layer.weights[8 + 1], weights.tensors.at(name + "conv.weight").values[8 + 1] * factor, 1e-6);
}

TEST(WeightsReader, RefusesWrongMetadata) {
  const auto with = [](const std::string& key, const std::string& value) {
    RandomWeights weights = narrow();
    weights.metadata[key] = value;
    return weights;
  };
  expect_file_refused(with("format", "stdc-weights-3"), "is neither stdc-weights-1 nor stdc-weights-2");
  expect_file_refused(with("format", "stdc-weights-2"), "has lost its checksum");
  expect_file_refused(with("architecture", "BiSeNet"), "neither STDC1-Seg nor STDC2-Seg");
  expect_file_refused(with("classes", "person"), "'classes': is not JSON");
  expect_file_refused(with("classes", R"(["one"])"), "fewer than two");
  expect_file_refused(with("classes", R"(["c0","c1","c2"])"),
                      "names 3 classes, but the network tells 2 apart");
  expect_file_refused(with("dynamic_classes", R"(["dog"])"), "'dog' is not among the classes");
  expect_file_refused(with("dynamic_classes", R"({"a":1})"), "not a list of names");
  expect_file_refused(with("classes", std::string(5000, '[')), "is not JSON");
  expect_file_refused(with("dynamic_classes", "[]"), "none of its classes would be dynamic");
  expect_file_refused(with("dynamic_classes", R"(["c0","c1"])"), "all of its classes would be dynamic");
  expect_file_refused(with("probability", "[1]"), "is not a list of scale and offset");
  expect_file_refused(with("probability", "[-1, 0]"), "'probability': is damaged");
  expect_file_refused(with("input_width", "500"), "500x384 is not a size");
  expect_file_refused(with("input_height", "0x20"), "not a whole number");
  expect_file_refused(with("mean", "[1,2]"), "list of three numbers");
  expect_file_refused(with("mean", "[124,116,104]"), "outside 0..1");
  expect_file_refused(with("std", "[0,1,1]"), "outside 0.01..10");
  expect_file_refused(with("activation_ranges", "[]"), "not an object");
  expect_file_refused(with("activation_ranges", R"({"a":[1]})"), "two numbers");
  expect_file_refused(with("activation_ranges", R"({"a":[2,1]})"), "the range of 'a' is damaged");
  expect_file_refused(with("activation_ranges", R"({"a":[0,1e300]})"), "the range of 'a' is damaged");
  for (const char* key :
       {"format", "architecture", "classes", "dynamic_classes", "input_width", "mean", "licence"}) {
    RandomWeights weights = narrow();
    weights.metadata.erase(key);
    expect_file_refused(weights, std::string("has no '") + key + "'");
  }
}

TEST(WeightsReader, RefusesWrongTensors) {
  for (const char* name : {"backbone.stage1.conv.weight", "backbone.stage5.1.blocks.3.bn.running_var",
                           "context.arm4.attention.bn.bias", "ffm.excite.weight", "head.classify.bias"}) {
    RandomWeights weights = narrow();
    weights.tensors.erase(name);
    expect_file_refused(weights, std::string("has no tensor '") + name + "'");
  }
  RandomWeights weights = narrow();
  weights.tensors["backbone.stage2.conv.weight"].shape = {8, 2, 6, 3};
  expect_file_refused(weights,
                      "'backbone.stage2.conv.weight': has the shape [8, 2, 6, 3], not [outputs, 4, 3, 3]");
  weights = narrow();
  weights.tensors["head.conv.bn.bias"].shape = {2, 4};
  expect_file_refused(weights, "'head.conv.bn.bias': has the shape [2, 4], not [8]");
  weights = narrow();
  weights.tensors["head.conv.bn.running_var"].values[3] = -1;
  expect_file_refused(weights, "'head.conv.bn.running_var': is negative");
  weights = narrow();
  weights.tensors["head.conv.bn.weight"].values[3] = 3e38F;
  weights.tensors["head.conv.bn.running_var"].values[3] = 0;
  expect_file_refused(weights, "makes the weights infinite");
  weights = narrow();
  weights.metadata["architecture"] = "STDC2-Seg";
  expect_file_refused(weights, "has no tensor 'backbone.stage3.2.blocks.0.conv.weight'");
}

TEST(WeightsReader, RefusesSumsOfDifferentWidths) {
  RandomWeights weights = narrow();
  const RandomWeights wider(false, {{4, 8}, {16, 16, 32}, 16, 16, 4, 8, 2});
  for (const char* suffix : {"conv.weight", "bn.weight", "bn.bias", "bn.running_mean", "bn.running_var"}) {
    const std::string name = std::string("context.pool.") + suffix;
    weights.tensors[name] = wider.tensors.at(name);
  }
  expect_file_refused(weights, "layer 'context.pool': has 16 channels where 8 are added to it");
}

TEST(WeightsReader, KnowsWhetherItIsCalibrated) {
  RandomWeights weights = narrow();
  weights.metadata.erase("activation_ranges");
  EXPECT_FALSE(weights.read().calibrated());
}

TEST(WeightsReader, OtherClassesCanBeChosen) {
  RandomWeights weights(false, {{4, 8}, {16, 16, 32}, 8, 16, 4, 8, 4});
  weights.metadata["probability"] = "[0.5, -0.25]";
  NetworkWeights network = weights.read();
  EXPECT_FLOAT_EQ(network.probability.scale, 0.5F);
  EXPECT_FLOAT_EQ(network.probability.offset, -0.25F);
  network.choose_dynamic(std::vector<std::string>{"c3", "c1"});
  EXPECT_EQ(network.dynamic_classes, (std::vector<bool>{false, true, false, true}));
  EXPECT_EQ(message_of([&] { network.choose_dynamic(std::vector<std::string>{"dog"}); }),
            "random weights: knows no class 'dog'; choose from c0, c1, c2, c3");
  EXPECT_EQ(network.dynamic_classes, (std::vector<bool>{false, true, false, true}));
}

TEST(WeightsReader, IgnoresOtherTensors) {
  RandomWeights weights = narrow();
  weights.tensors["detail.conv.weight"] = {{1, 1}, {0.5F}};
  EXPECT_EQ(message_of([&] { weights.read(); }), "");
}

}  // namespace
}  // namespace stdc
