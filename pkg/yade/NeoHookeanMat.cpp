// SPDX-License-Identifier: GPL-2.0-or-later
#include "NeoHookeanMat.hpp"

namespace yade {
YADE_PLUGIN((NeoHookeanMat));
}
