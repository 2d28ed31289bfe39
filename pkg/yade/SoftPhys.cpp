// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftPhys.hpp"

namespace yade {
YADE_PLUGIN((SoftPhys));
}
