// SPDX-License-Identifier: GPL-2.0-or-later
#include "MooneyRivlinMat.hpp"

namespace yade {
YADE_PLUGIN((MooneyRivlinMat));
}
