#pragma once
// The label and the result phrases of each check, for screens and pages. A test compares the rows
// with record::every_check.

#include <array>
#include <string_view>

#include "record/check.hpp"

namespace triptych::report::words {

struct CheckWords {
  record::Check check;
  std::string_view label;
  std::string_view wrong;   // the last word of "18 of 66 checks wrong"
  std::string_view passed;  // the text after the number in "264 within their error bounds"
  std::string_view none;    // shown if the check reached no verdict
  bool always;              // whether the row is shown even if the check did not run
};

// The same for a topic (judge::topic_of).
struct TopicWords {
  std::string_view topic;
  std::string_view label;
  std::string_view wrong;
  std::string_view passed;
  std::string_view none;
  bool always;
};

// A topic that is not a check: its row is shown only if it has findings. `sentence` is followed by
// the devices, or by the plans if the findings belong to no device.
struct NoticeWords {
  std::string_view topic;
  std::string_view label;
  std::string_view sentence;
};

inline constexpr std::array notice_words{
    NoticeWords{"driver", "Driver", "faults that are not limited to one image"},
    NoticeWords{"baselines", "Baselines", "none"},
};
// The sentence of a check that needs baselines, if there are none.
inline constexpr std::string_view nothing_to_compare = "not checked: there are no baselines";

inline constexpr std::array check_words{
    CheckWords{record::Check::image, "Images", "wrong", "within their error bounds", "not checked",
               true},
    CheckWords{record::Check::counters, "Counters", "changed", "as stored", "not checked", true},
    CheckWords{record::Check::statistics, "Statistics", "changed", "as stored", "not checked",
               true},
    CheckWords{record::Check::cost, "Cost", "changed", "as stored", "not checked", true},
    CheckWords{record::Check::code, "Code", "worse", "as stored", "not checked", false},
    CheckWords{record::Check::memory, "Memory", "changed", "as stored", "not checked", true},
    CheckWords{record::Check::timing, "Times", "slower", "not slower", "not checked", true},
    CheckWords{record::Check::correlation, "Devices", "off the fitted line", "on the fitted line",
               "shown, not judged", false},
    CheckWords{record::Check::accuracy, "Accuracy", "changed", "as stored", "not checked", false},
    CheckWords{record::Check::stress, "Stress", "below their stored score", "at their stored score",
               "not checked", false},
};

}  // namespace triptych::report::words
