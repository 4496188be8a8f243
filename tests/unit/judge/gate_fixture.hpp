#pragma once
// Additions to the fixture for tests of the gate.

#include "core/file.hpp"
#include "core/json.hpp"
#include "fixture.hpp"

namespace triptych::judge {

class GateTest : public JudgeTest {
 protected:
  void write_waivers(const std::string& expiry, const std::string& device = "vulkan:*",
                     const std::string& configuration = "*",
                     const std::string& test = "volume.quick.image.*") {
    const core::Json waivers = {{{"device", device},
                                 {"test", test},
                                 {"configuration", configuration},
                                 {"reason", "known driver fault"},
                                 {"expiry", expiry}}};
    core::write_file(waivers.dump(), folder_.path() / "baselines" / "waivers.json");
  }
  static JudgeTest::Tweak wrong_image_on(const std::string& device) {
    return [device](record::Record& record, core::Image& image) {
      if (record.device == device && record.configuration == plain_) image.rgba[4 * 11] += 0.01F;
    };
  }
};

}  // namespace triptych::judge
