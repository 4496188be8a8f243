#include "record/statistic_worth.hpp"

#include "record/names.hpp"

namespace triptych::record {
namespace {

constexpr Names<Worth, 9> worth_names{{
    {Worth::exact, "exact"},
    {Worth::counts, "counts"},
    {Worth::proportional, "proportional"},
    {Worth::inflated, "inflated"},
    {Worth::differs, "differs"},
    {Worth::unsteady, "unsteady"},
    {Worth::absent, "absent"},
    {Worth::unknown, "unknown"},
    {Worth::not_calibrated, "not_calibrated"},
}};

}  // namespace

std::string_view name_of(Worth worth) {
  return name_in(worth_names, worth);
}

Worth worth(std::string_view name) {
  return value_named(worth_names, "statistic worth", name);
}

}  // namespace triptych::record
