#include "fuzzed.hpp"
#include "record/merge/merge.hpp"
#include "record/store.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace triptych;
  const std::filesystem::path file = fuzz::write("s.sqlite", fuzz::text_of(data, size));
  fuzz::expect_typed_errors([&] {
    const record::Store store(file, record::Store::Mode::read);
    // Does not call require_whole(), because that would reject most damaged files before they are
    // read.
    for (const record::Run& run : store.runs()) {
      fuzz::expect_typed_errors([&] { static_cast<void>(store.devices(run.id)); });
      for (const record::Record& record : store.records(run.id)) {
        fuzz::expect_typed_errors([&] { static_cast<void>(store.decoded_image(record.image)); });
        fuzz::expect_typed_errors([&] { static_cast<void>(store.truth(record.scene, "1")); });
      }
    }
  });
  // A merge copies values without reading them as records, so it is tested separately.
  const std::filesystem::path out = fuzz::folder() / "out.sqlite";
  fuzz::expect_typed_errors([&] { static_cast<void>(record::merge_stores({file}, out)); });
  std::filesystem::remove(out);
  return fuzz::judged;
}
