#pragma once
// How much slower than usual a device was in each run, and whether its program as a whole was; the
// derivation is in judge/timing/model.hpp.

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "judge/statistics/statistics.hpp"
#include "judge/timing/model.hpp"

namespace triptych::judge {

// What is to be taken out of one case.
struct CaseShift {
  std::map<std::string, double> stored;  // by run; empty: nothing tells any shift, so there is none
  double now = 0;
  double variance = 0;
};

// ln t of the stored runs without the shift. A run of which others' shifts are known and its own is
// not is left out: how fast the device was in it, nobody knows.
[[nodiscard]] std::vector<double> stored_logarithms(const TimingCase& timing,
                                                    const CaseShift& shift = {});

// Of all cases of one device, which have to live as long.
class DeviceShifts {
 public:
  explicit DeviceShifts(std::span<const TimingCase* const> cases);
  // s_d² with ν; no degrees where anchors, a body or stored runs are missing.
  [[nodiscard]] KnownVariance scatter_of_program() const;
  // `others`: s_d² of all devices. To be called before what follows.
  void judge_program(const VariancePrior& others);
  [[nodiscard]] CaseShift of(const TimingCase& timing) const;
  // nullopt where anchors or a body are missing.
  [[nodiscard]] const std::optional<ProgramJudgement>& program() const { return program_; }
  [[nodiscard]] std::size_t anchors() const { return anchors_.now.size(); }

 private:
  // Deviations from the cases' means, ascending, each with its case.
  using Deviations = std::vector<std::pair<double, const TimingCase*>>;
  struct Witness {
    std::map<std::string, Deviations> stored;
    Deviations now;
    void add(const TimingCase& timing);
    void sort();
  };

  [[nodiscard]] static std::vector<double> without(const Deviations& deviations,
                                                   const TimingCase* left_out);
  [[nodiscard]] static CaseShift medians(const Witness& witness, const TimingCase* left_out);
  [[nodiscard]] double scatter_of_anchors() const;
  [[nodiscard]] double scatter_of_body() const;
  [[nodiscard]] double variance_of_body(const TimingCase* left_out) const;

  Witness anchors_;
  Witness body_;
  CaseShift by_anchors_;               // and the variance V, where there is a program to be judged
  CaseShift by_body_;                  // of all of it
  double typical_scatter_ = 0;         // s₀² of the body
  std::vector<double> distances_;      // d of the stored runs
  std::vector<double> anchor_shifts_;  // in them
  std::optional<ProgramJudgement> program_;
};

}  // namespace triptych::judge
