#pragma once
// The folder of baselines to which `accept` writes.

#include <filesystem>
#include <string>

namespace triptych::app {

// The folder that the user names, or ./baselines. The baselines that were installed with the
// program are never written to. If ./baselines does not exist, it is started as a copy of them,
// which takes effect when everything was accepted: until then it has another name.
class OwnBaselines {
 public:
  // `named`: the option's value; empty: ./baselines.
  explicit OwnBaselines(const std::string& named);
  // Removes a copy that did not take effect.
  ~OwnBaselines();
  OwnBaselines(const OwnBaselines&) = delete;
  OwnBaselines& operator=(const OwnBaselines&) = delete;

  // The folder to write to.
  [[nodiscard]] const std::filesystem::path& folder() const { return working_; }
  // The name that it has when everything was accepted.
  [[nodiscard]] const std::filesystem::path& name() const { return name_; }
  // The folder that it was copied from; empty if it was not copied.
  [[nodiscard]] const std::filesystem::path& copied_from() const { return copied_from_; }
  // Everything was accepted.
  void keep();

 private:
  std::filesystem::path name_;
  std::filesystem::path working_;
  std::filesystem::path copied_from_;
};

}  // namespace triptych::app
