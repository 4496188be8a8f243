// The main function of all GoogleTest programs. If all tests that ran were skipped, the exit code is
// 77, by which CTest recognises a skipped test.

#include <gmock/gmock.h>

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  const int failed = RUN_ALL_TESTS();
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  constexpr int skipped = 77;
  const bool only_skipped = all.skipped_test_count() > 0 && all.successful_test_count() == 0;
  return failed == 0 && only_skipped ? skipped : failed;
}
