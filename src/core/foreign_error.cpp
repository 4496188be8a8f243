#include "core/foreign_error.hpp"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "core/error.hpp"

namespace triptych::core {
namespace {

std::string joined(const std::string& about, const std::string& message) {
  return about.empty() ? message : about + ": " + message;
}

}  // namespace

void rethrow_converted(const std::string& about) {
  try {
    throw;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw IoError(joined(about, "not enough memory is available"));
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string file = error.path1().string();
    throw IoError(joined(file.empty() ? about : file, error.code().message()));
  } catch (const std::system_error& error) {
    throw IoError(joined(about, error.code().message()));
  } catch (const std::exception& error) {
    if (!about.empty()) {
      throw InputError({.file = about}, fmt::format("cannot be used ({})", error.what()));
    }
    throw Error(
        fmt::format("internal error in Triptych ({}); please report it together with the command "
                    "and its input files",
                    error.what()));
  }
}

}  // namespace triptych::core
