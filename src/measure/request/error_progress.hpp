#pragma once
// The progress of the search that `--error E` makes, and its failures, as data
// (report/words/requested_error.hpp turns them into sentences).

#include <cstddef>
#include <cstdint>
#include <string>

#include "accuracy/accuracy.hpp"
#include "accuracy/requested_error.hpp"

namespace triptych::measure {

struct ErrorProgress {
  enum class Phase : std::uint8_t {
    begin,        // the search begins: `scenes`, `viewport`
    step_search,  // computes small images to find a first step: `scene`, `quadrature`, `viewport`
    step_found,   // the first step has been found: `scene`, `quadrature`, `step`
    trials        // devices draw trial images: `round`, `settings`
  };
  Phase phase = Phase::begin;
  std::string scene = {};
  std::size_t scene_number = 0;  // the first scene has the number 1
  std::size_t scenes = 0;
  std::string viewport = {};
  std::string quadrature = {};
  accuracy::StepError step = {};  // the first step, and its estimated error
  bool meets_share = false;       // whether this error is small enough for trials
  accuracy::Metric metric = accuracy::Metric::rms;
  int round = 0;             // the first round of trials has the number 1
  std::size_t settings = 0;  // number of configurations that each device draws in this round
};

// The reason why no setting can meet the requested error in a scene.
struct Unreachable {
  enum class Why : std::uint8_t {
    no_limit_image,  // a stress scene has none
    empty_image,     // an empty image already meets the error
    step             // the error is too large with every step
  };
  std::string scene;
  Why why = Why::no_limit_image;
  double error = 0;           // the error of the empty image, or the smallest error of any step
  double allowed = 0;         // the share of the requested error that was allowed for the step
  std::string viewport = {};  // size of the image whose error is `error`
  std::size_t covered = 0;    // for an empty image: non-background pixels of the limit image,
  std::size_t pixels = 0;     // and all its pixels
};

}  // namespace triptych::measure
