#pragma once
// The folder of baselines to which `accept` writes.

#include <filesystem>
#include <string>

namespace triptych::app {

// The folder that the user names, or ./baselines. The baselines that were installed with the
// program are never changed. If ./baselines does not exist, they are copied to a folder with a
// temporary name, which is renamed to ./baselines when everything was accepted.
class OwnBaselines {
 public:
  // `named`: the option's value; empty: ./baselines.
  explicit OwnBaselines(const std::string& named);
  // Removes the copy if keep() was not called.
  ~OwnBaselines();
  OwnBaselines(const OwnBaselines&) = delete;
  OwnBaselines& operator=(const OwnBaselines&) = delete;

  // The folder to write to.
  [[nodiscard]] const std::filesystem::path& folder() const { return working_; }
  // The name of the folder after everything was accepted.
  [[nodiscard]] const std::filesystem::path& name() const { return name_; }
  // The folder that it was copied from; empty if it was not copied.
  [[nodiscard]] const std::filesystem::path& copied_from() const { return copied_from_; }
  // Makes the copy permanent. Call this when everything was accepted.
  void keep();

 private:
  std::filesystem::path name_;
  std::filesystem::path working_;
  std::filesystem::path copied_from_;
};

}  // namespace triptych::app
