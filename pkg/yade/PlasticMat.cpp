// SPDX-License-Identifier: GPL-2.0-or-later
#include "PlasticMat.hpp"

namespace yade {
YADE_PLUGIN((PlasticMat));
}
