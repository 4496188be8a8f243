#include "judge/gate.hpp"
