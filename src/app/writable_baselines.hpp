#pragma once
// The baselines folder to which `accept` writes.

#include <filesystem>
#include <string>

namespace triptych::app {

// The folder that the user names, or ./baselines by default. The baselines that were installed with
// the program are never changed. If ./baselines does not exist, the installed baselines are copied
// to a temporary folder, which is renamed to ./baselines when all plans have been accepted.
class WritableBaselines {
 public:
  // `named` is the option's value. If it is empty, ./baselines is used.
  explicit WritableBaselines(const std::string& named);
  // Removes the copy if commit() was not called.
  ~WritableBaselines();
  WritableBaselines(const WritableBaselines&) = delete;
  WritableBaselines& operator=(const WritableBaselines&) = delete;

  // Returns the folder to write to.
  [[nodiscard]] const std::filesystem::path& folder() const { return working_; }
  // Returns the name that the folder has after all plans have been accepted.
  [[nodiscard]] const std::filesystem::path& name() const { return name_; }
  // Returns the folder from which the baselines were copied, or an empty path if nothing was
  // copied.
  [[nodiscard]] const std::filesystem::path& copied_from() const { return copied_from_; }
  // Makes the copy permanent. Call this after all plans have been accepted.
  void commit();

 private:
  std::filesystem::path name_;
  std::filesystem::path working_;
  std::filesystem::path copied_from_;
};

}  // namespace triptych::app
