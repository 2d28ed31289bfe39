// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/types.hpp"

#include <sstream>

namespace softgrain {

std::string shown(double value, int digits)
{
    std::ostringstream text;
    text.precision(digits);
    text << value;
    return text.str();
}

} // namespace softgrain
