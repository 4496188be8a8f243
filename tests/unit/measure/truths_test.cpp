// Tests that each reference image is rendered only once, and then reused by the same command and by
// later commands.

#include "measure/truth/truths.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "core/temporary_folder.hpp"
#include "measure/truth/own_seal.hpp"
#include "stub_suite.hpp"
#include "tests/unit/measure_run/scratch.hpp"

namespace triptych::measure {
namespace {

// A suite whose image depends only on the step size.
class TruthfulSuite final : public StubSuite {
 public:
  int rendered = 0;
  bool has_data = true;

  std::string_view name() const override { return "truthful"; }
  accuracy::TruthPair truth(const Configuration& configuration,
                            const std::map<std::string, double>&) override {
    ++rendered;
    accuracy::TruthPair pair{core::Image(2, 2), core::Image(2, 2)};
    pair.truth.rgba[0] = std::stof(configuration.at("step"));
    pair.bound.rgba[0] = 0.25F;
    return pair;
  }
  std::string truth_key(const Configuration& configuration,
                        const std::map<std::string, double>&) override {
    return configuration.at("step");
  }
  std::string limit_key(const Configuration& configuration) override {
    return configuration.at("step") == "2" ? "" : "limit";
  }
  Limit limit(const Configuration&) override {
    ++rendered;
    return {core::Image(3, 3), core::Image(3, 3)};
  }
  std::string data_hash(const Configuration&) override {
    if (!has_data) throw core::InputError("gone");
    return "hash";
  }
};

record::Record record_with(const std::string& step) {
  record::Record record;
  record.suite = "truthful";
  record.scene = "step=" + step;
  record.factors = {{"step", step}};
  return record;
}

class TruthsTest : public testing::Test {
 protected:
  [[nodiscard]] Truths truths(record::Store& store) {
    return {[this](std::string_view) -> SuiteWithTruth& { return suite_; }, store};
  }
  [[nodiscard]] record::Store store(record::Store::Mode mode = record::Store::Mode::append) const {
    return {folder_.path() / "store", mode};
  }

  core::TemporaryFolder folder_;
  TruthfulSuite suite_;
};

TEST_F(TruthsTest, AreRenderedOnceAndReused) {
  record::Store first = store();
  Truths fresh = truths(first);
  const accuracy::TruthPair* pair = &fresh.of(record_with("1"));
  EXPECT_EQ(pair->truth.rgba[0], 1);
  EXPECT_EQ(fresh.of(record_with("0.5")).truth.rgba[0], 0.5F);
  EXPECT_EQ(&fresh.of(record_with("1")), pair);
  EXPECT_EQ(suite_.rendered, 2);
  record::Store second = store();
  EXPECT_EQ(truths(second).of(record_with("1")).bound.rgba[0], 0.25F);
  EXPECT_EQ(suite_.rendered, 2);
}

// Anyone can write a reference image with a valid seal (a hash) into a store before passing the
// store on. Therefore, only reference images that this user rendered on this machine are trusted.
TEST_F(TruthsTest, ABoundFromAnotherUserIsComputedAgain) {
  {
    record::Store first = store();
    static_cast<void>(truths(first).of(record_with("1")));
    record::TruthImage widened = first.truth("step=1", "1").value();
    EXPECT_EQ(own_seal(widened), widened.own_seal);
    core::Image wide(2, 2);
    for (float& each : wide.rgba) each = 1e6F;
    widened.bound = core::encode_exr(wide);
    first.set_truth(widened);
  }
  record::Store second = store();
  EXPECT_EQ(truths(second).of(record_with("1")).bound.rgba[0], 0.25F);
  EXPECT_EQ(suite_.rendered, 2);
  EXPECT_EQ(truths(second).of(record_with("1")).bound.rgba[0], 0.25F);
  // The image was rendered by this user, so it is trusted.
  EXPECT_EQ(suite_.rendered, 2);
}

// The second seal depends on a key that only the user who rendered the image can read.
TEST_F(TruthsTest, TheKeyOfEachUserIsSecretAndDifferent) {
  const auto cache = [&](const char* user) {
    return Variable("XDG_CACHE_HOME", (folder_.path() / user).string());
  };
  {
    const Variable one = cache("one");
    record::Store first = store();
    static_cast<void>(truths(first).of(record_with("1")));
  }
  const Variable other = cache("other");
  record::Store second = store();
  static_cast<void>(truths(second).of(record_with("1")));
  EXPECT_EQ(suite_.rendered, 2);
  const auto key = folder_.path() / "other/triptych/references/key";
  EXPECT_EQ(std::filesystem::status(key).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  std::filesystem::permissions(key, std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  EXPECT_EQ(own_seal({}), std::nullopt) << "a key that others can read was used";
}

// Test cases 1, 2 and 6 of RFC 4231.
TEST(OwnSeal, MatchesTheStandard) {
  EXPECT_EQ(hmac_sha256(std::string(20, '\x0b'), "Hi There"),
            "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
  EXPECT_EQ(hmac_sha256("Jefe", "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(hmac_sha256(std::string(131, '\xaa'),
                        "Test Using Larger Than Block-Size Key - Hash Key First"),
            "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
}

TEST_F(TruthsTest, AreCorrectIfTheyCannotBeStored) {
  static_cast<void>(store());
  record::Store read = store(record::Store::Mode::read);
  EXPECT_EQ(truths(read).of(record_with("1")).truth.rgba[0], 1);
}

TEST_F(TruthsTest, LimitImagesAreStoredToo) {
  record::Store first = store();
  Truths fresh = truths(first);
  EXPECT_EQ(fresh.limit_of(record_with("2")), nullptr);
  const accuracy::LimitImage* limit = fresh.limit_of(record_with("1"));
  ASSERT_NE(limit, nullptr);
  EXPECT_EQ(limit->image.width, 3);
  EXPECT_EQ(fresh.limit_of(record_with("0.5")), limit);
  EXPECT_EQ(truths(first).limit_of(record_with("1"))->key, "limit");
  EXPECT_EQ(suite_.rendered, 1);
}

TEST_F(TruthsTest, NoDataHaveNoHash) {
  record::Store first = store();
  suite_.has_data = false;
  EXPECT_EQ(truths(first).data_hash_of(record_with("1")), "");
  suite_.has_data = true;
  EXPECT_EQ(truths(first).data_hash_of(record_with("1")), "hash");
}

}  // namespace
}  // namespace triptych::measure
