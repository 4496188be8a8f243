#include "analysis/analysis.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "synthetic.hpp"
#include "core/error.hpp"
#include "core/random.hpp"
#include "analysis/splits.hpp"
#include "analysis/tables.hpp"

namespace triptych::analysis {
namespace {

const LevelPair& cell(const Matrix& matrix, const std::string& a, const std::string& b) {
  for (const LevelPair& each : matrix.cells) {
    if (each.a == a && each.b == b) return each;
  }
  throw std::out_of_range(a + " " + b);
}

// Anscombe 1973, first set: r = 0.81642, the line 3.0001 + 0.50009 x.
constexpr std::array<double, 11> anscombe_x{10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
constexpr std::array<double, 11> anscombe_y{8.04, 6.95, 7.58,  8.81, 8.33, 9.96,
                                            7.24, 4.26, 10.84, 4.82, 5.68};

Dataset anscombe() {
  std::vector<std::string> cases;
  for (std::size_t i = 0; i < anscombe_x.size(); ++i) cases.push_back(std::to_string(i));
  return factorial({{"device", {"x", "y"}}, {"data", cases}}, [](const Factors& at) {
    const auto i = static_cast<std::size_t>(std::stoi(at.at("data")));
    return at.at("device") == "x" ? anscombe_x[i] : anscombe_y[i];
  });
}

TEST(Analysis, AnscombesCorrelationAndLine) {
  const Dataset dataset = anscombe();
  const Split devices = split(dataset, "device");
  const LevelPair& pair = cell(correlations(devices), "x", "y");
  EXPECT_EQ(pair.pairs, 11U);
  EXPECT_NEAR(*pair.r, 0.81642, 5e-6);
  const auto lines = speed_ups(devices, "y");
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].speed_up, 0.50009, 5e-6);
  EXPECT_NEAR(lines[0].intercept_ms, 3.00009, 5e-6);
  EXPECT_NEAR(lines[0].error, (1 - 0.81642) * 0.50009, 5e-6);
}

// Device b is 3 + 2·a; c is unrelated; their factors are told in the scope.
TEST(Analysis, MatrixOfKnownStructure) {
  core::Random random(5);
  const Dataset dataset = factorial(
      {{"device", {"a", "b", "c"}},
       {"data", {"1", "2", "3", "4", "5", "6", "7", "8", "9", "10"}},
       {"viewport", {"96", "192"}},
       {"step", {"1"}}},
      [&](const Factors& at) {
        const double base = std::stod(at.at("data")) * (at.at("viewport") == "96" ? 1 : 4);
        if (at.at("device") == "a") return base;
        return at.at("device") == "b" ? 3 + 2 * base : random.uniform(1, 10);
      });
  const Matrix matrix = correlations(split(dataset, "device"));
  ASSERT_EQ(matrix.cells.size(), 3U);
  EXPECT_NEAR(*cell(matrix, "a", "b").r, 1, 1e-12);
  EXPECT_LT(std::abs(*cell(matrix, "a", "c").r), 0.6);
  EXPECT_EQ(matrix.scope.samples, 60U);
  EXPECT_EQ(text_of(matrix.scope.held), "step=1");
  const Box box = *box_of(matrix);
  EXPECT_EQ(box.cells, 3U);
  EXPECT_NEAR(box.quartiles.maximum, 1, 1e-12);
  const auto lines = speed_ups(split(dataset, "device"), "b");
  EXPECT_NEAR(lines.at(0).speed_up, 2, 1e-12);  // b takes twice as long, and 3 ms
  EXPECT_NEAR(lines.at(0).intercept_ms, 3, 1e-9);
}

TEST(Analysis, OnlyWhatBothLevelsHaveIsPaired) {
  Dataset dataset = anscombe();
  std::erase_if(dataset.observations, [](const Observation& each) {
    return each.factors.at("device") == "y" && number(each.factors.at("data")).value() > 2;
  });
  const Matrix matrix = correlations(split(dataset, "device"));
  EXPECT_EQ(matrix.cells.at(0).pairs, 3U);
  EXPECT_FALSE(matrix.cells.at(0).r);  // too few to say
  EXPECT_FALSE(box_of(matrix));
}

TEST(Analysis, PartsOfTheCamera) {
  const Dataset dataset =
      factorial({{"camera", {"orbit_y:0/2", "orbit_y:1/2", "path_z:0/2", "path_z:1/2", "random:1"}},
                 {"data", {"1", "2", "3", "4", "5"}}},
                [](const Factors& at) { return std::stod(at.at("data")); });
  const Split paths = split(dataset, camera_path);
  ASSERT_EQ(paths.levels.size(), 2U);
  EXPECT_EQ(correlations(paths).cells.at(0).pairs, 10U);  // by position and data
  EXPECT_EQ(correlations(split(dataset, camera_rotation)).cells.at(0).pairs, 5U);
  const Split distances = split(dataset, camera_distance);
  EXPECT_EQ(distances.levels.at(1).name, "1/2");
  EXPECT_EQ(factors_of(dataset), (std::vector<std::string>{"camera_distance", "camera_path",
                                                           "camera_rotation", "data"}));
}

TEST(Analysis, MeansComeFromComparableConfigurations) {
  Dataset dataset = factorial({{"device", {"a", "b"}}, {"data", {"x", "y"}}, {"step", {"1", "2"}}},
                              [](const Factors& at) { return std::stod(at.at("step")); });
  // Device b lacks one step-2 configuration: step 2 would make the other cells dearer.
  std::erase_if(dataset.observations, [](const Observation& each) {
    return each.factors == Factors{{"device", "b"}, {"data", "y"}, {"step", "2"}};
  });
  const MeanTimes means = mean_times(dataset, "data", "device");
  ASSERT_EQ(means.cells.size(), 4U);
  for (const MeanCell& each : means.cells) EXPECT_EQ(each.mean_ms, 1);
  EXPECT_EQ(text_of(means.scope.held), "step=1");
  EXPECT_TRUE(mean_times(dataset, "data", "technique").cells.empty());
}

TEST(Analysis, LogNormalByMaximumLikelihood) {
  const std::vector<double> values{std::exp(1), std::exp(2), std::exp(3)};
  const LogNormal fit = fit_log_normal(values);
  EXPECT_NEAR(fit.mu, 2, 1e-12);
  EXPECT_NEAR(fit.sigma, std::sqrt(2.0 / 3), 1e-12);
}

Dataset drawn(const std::function<double(core::Random&)>& time) {
  core::Random random(11);
  std::vector<std::string> cases;
  for (int i = 0; i < 400; ++i) cases.push_back(std::to_string(i));
  return factorial({{"device", {"a"}}, {"data", cases}},
                   [&](const Factors&) { return time(random); });
}

TEST(Analysis, LogNormalTimesAreNotRejectedAndUniformOnesAre) {
  const auto normal = [](core::Random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.uniform();
    return sum;
  };
  const auto fits =
      distributions(drawn([&](core::Random& random) { return std::exp(normal(random)); }), 1);
  ASSERT_EQ(fits.size(), 2U);  // all, and of the device
  EXPECT_GT(fits[0].lilliefors_p, 0.05);
  EXPECT_GT(fits[0].ks_p, fits[0].lilliefors_p);  // parameters taken for given
  double count = 0;
  double expected = 0;
  for (const Bin& bin : fits[0].logarithmic) {
    count += static_cast<double>(bin.count);
    expected += bin.expected;
  }
  EXPECT_EQ(count, 400);
  EXPECT_NEAR(expected, 400, 5);
  const auto misfits =
      distributions(drawn([](core::Random& random) { return random.uniform(1, 100); }), 1);
  EXPECT_LT(misfits.at(0).lilliefors_p, 0.01);
}

TEST(Analysis, PercentilesInterpolate) {
  double next = 0;
  const Dataset dataset = drawn([&](core::Random&) { return ++next; });  // 1 … 400
  const auto all = distributions(dataset, 1);
  EXPECT_NEAR(all.at(0).percentiles.at(4).second, 200.5, 1e-12);
  EXPECT_NEAR(all.at(0).percentiles.at(1).second, 1 + 0.05 * 399, 1e-9);
}

// Every structure has its own line over device and pixels, which the lines find and one forest
// follows roughly.
TEST(Analysis, LinesPerStructurePredictWhatIsLinearThere) {
  const Dataset dataset =
      factorial({{"data", {"x", "y"}},
                 {"camera", {"random:1", "random:2", "random:3"}},
                 {"device", {"a", "b", "c"}},
                 {"viewport", {"32", "64", "96", "128"}},
                 {"step", {"0.5", "1", "2"}}},
                [](const Factors& at) {
                  const double side = std::stod(at.at("viewport"));
                  const double device = at.at("device") == "a" ? 1 : 4;
                  const double scale = at.at("data") == "x" ? 1 : 20;
                  return scale * (device + side * side / 1e3 + 1 / std::stod(at.at("step")));
                });
  const PredictionOutcome outcome = predict(dataset, 1);
  ASSERT_TRUE(outcome.prediction);
  const Prediction& prediction = *outcome.prediction;
  EXPECT_EQ(prediction.structures, 6U);
  EXPECT_EQ(prediction.structures_left_out, 0U);
  EXPECT_NEAR(*prediction.line_least, 1, 1e-9);
  EXPECT_GT(*prediction.forest_on_all, 0.8);
  EXPECT_EQ(prediction.structure, (std::vector<std::string>{"camera", "data"}));
  EXPECT_EQ(prediction.scores.back().data, "all");
  EXPECT_EQ(prediction.scores.back().models, 6U);
  EXPECT_EQ(prediction.trained + prediction.held_out, dataset.observations.size());
}

// A precision multiplies every time, and merged samples are no number of samples: neither is a term
// of a line.
TEST(Analysis, PrecisionAndAdaptPartTheLines) {
  const Dataset dataset = factorial(
      {{"data", {"x"}},
       {"precision", {"fp32", "fp64"}},
       {"adapt", {"0", "0.001", "0.01"}},
       {"device", {"a", "b"}},
       {"viewport", {"32", "48", "64", "96", "128"}}},
      [](const Factors& at) {
        const double side = std::stod(at.at("viewport"));
        const double precision = at.at("precision") == "fp64" ? 3 : 1;
        const double adapt = at.at("adapt") == "0" ? 1 : at.at("adapt") == "0.01" ? 0.4 : 0.9;
        return precision * adapt * ((at.at("device") == "a" ? 1 : 4) + side * side / 1e3);
      });
  const PredictionOutcome outcome = predict(dataset, 1);
  ASSERT_TRUE(outcome.prediction);
  EXPECT_EQ(outcome.prediction->structure, (std::vector<std::string>{"adapt", "precision"}));
  EXPECT_EQ(outcome.prediction->structures, 6U);
  EXPECT_NEAR(*outcome.prediction->line_least, 1, 1e-9);
}

TEST(Analysis, TooLittleToPredictFrom) {
  const PredictionOutcome outcome = predict(anscombe(), 1);
  EXPECT_FALSE(outcome.prediction);
  EXPECT_NE(outcome.reason.find("22 observations"), std::string::npos);
}

// On the orbit everything takes four times as long: it does not stand for all views.
TEST(Analysis, APathApartIsRejectedAndRandomSamplesAreNot) {
  core::Random random(3);
  std::vector<std::string> cases;
  for (int i = 0; i < 30; ++i) cases.push_back(std::to_string(i));
  const Dataset dataset = factorial(
      {{"camera", {"orbit_y:0/2", "orbit_y:1/2", "random:1", "random:2", "random:3", "random:4"}},
       {"data", cases}},
      [&](const Factors& at) {
        return random.uniform(1, 2) * (at.at("camera").starts_with("orbit") ? 4 : 1);
      });
  const auto tests = path_tests(dataset, 1);
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_EQ(tests[0].path, "orbit_y");
  EXPECT_EQ(tests[0].samples, 60U);
  EXPECT_EQ(tests[0].all_samples, 180U);
  EXPECT_LT(tests[0].test.p, 1e-6);
  EXPECT_NEAR(tests[0].test.d, 2.0 / 3, 1e-12);
  EXPECT_EQ(tests[0].of_samples.subsets, subset_count);
  EXPECT_LT(tests[0].of_samples.rejected, 10U);
  // Two views of six: both on the orbit in 1 of 15 subsets, and then as far.
  EXPECT_GT(tests[0].of_views.d_mean, tests[0].of_samples.d_mean);
}

TEST(Analysis, StacksAreSizesOfOneName) {
  const Dataset dataset = factorial(
      {{"data", {"generate:a:32", "generate:a:64", "generate:b:32", "file.nrrd"}},
       {"camera", {"random:1", "random:2", "random:3", "random:4"}}},
      [](const Factors& at) {
        return std::stod(at.at("camera").substr(7)) * (at.at("data").ends_with("64") ? 8 : 1);
      });
  const auto found = stacks(dataset);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "generate:a");
  EXPECT_NEAR(found[0].box.mean, 1, 1e-12);
}

TEST(Analysis, SaysWhatIsLeftOutAndWhy) {
  Dataset single{.suite = "volume", .clock = "wall"};
  single.observations.push_back({.factors = {{"device", "a"}, {"data", "x"}}, .ms = 1});
  const SuiteAnalysis analysis = analyze(single, {});
  EXPECT_TRUE(analysis.empty());
  EXPECT_GE(analysis.left_out.size(), 5U);
  for (const LeftOut& each : analysis.left_out) EXPECT_FALSE(each.reason.empty());
}

TEST(Analysis, AReferenceThatIsNoLevelIsRefused) {
  const Request request{.references = {{"device", "z"}}};
  EXPECT_THROW(static_cast<void>(analyze(anscombe(), request)), core::InputError);
  const Request good{.references = {{"device", "y"}}};
  EXPECT_EQ(analyze(anscombe(), good).speed_ups.at(0).reference.size(), 1U);
}

TEST(Analysis, TablesAsCsvAndJson) {
  const SuiteAnalysis analysis = analyze(anscombe(), {});
  const auto all = tables(analysis);
  const auto rows = rows_of(all, "correlations");
  EXPECT_EQ(rows.size(), 1U + 0U);
  EXPECT_NEAR(rows.at(0).at("r").get<double>(), 0.81642, 5e-6);
  Table table{"t", "T", {"a", "b"}};
  table.rows = {{{"a", "x,\"y\""}, {"b", nullptr}}, {{"a", 1.5}, {"b", 2}}};
  EXPECT_EQ(csv(table), "a,b\n\"x,\"\"y\"\"\",\n1.5,2\n");
  const core::Json json = to_json({analysis});
  EXPECT_EQ(json.at("suites").at(0).at("suite"), "volume");
  EXPECT_TRUE(json.at("suites").at(0).at("tables").contains("left_out"));
}

// Two techniques, each measured on data of its own: between all four the technique would differ
// too.
TEST(Analysis, TheFullestBlockHoldsOneSetOfCombinations) {
  const auto of = [](const std::string& technique, const std::vector<std::string>& data,
                     const std::vector<std::string>& steps) {
    return factorial(
        {{"device", {"x", "y"}}, {"data", data}, {"step", steps}, {"technique", {technique}}},
        [](const Factors&) { return 1.0; });
  };
  Dataset both = of("raycast", {"a", "b"}, {"1"});
  const Dataset more = of("raycast_fragment", {"c", "d"}, {"1", "2"});
  both.observations.insert(both.observations.end(), more.observations.begin(),
                           more.observations.end());
  const std::array<std::string_view, 2> factors{"data", "device"};
  const Chosen chosen = fullest_block(all_of(both), factors);
  EXPECT_EQ(chosen.size(), more.observations.size());
  for (const Observation* each : chosen) {
    EXPECT_EQ(each->factors.at("technique"), "raycast_fragment");
  }
}

}  // namespace
}  // namespace triptych::analysis
