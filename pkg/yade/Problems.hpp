// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <mutex>
#include <string>

namespace yade {

/// Functors run inside YADE's parallel loops, where an exception would end the process. They leave their first
/// problem here, and the next engine of ours throws it.
class Problems {
public:
    static void note(const std::string& sentence);
    /// Throws std::runtime_error with the noted sentence, if there is one, and forgets it.
    static void raise();
    /// Runs work, noting what it throws; false if it did.
    template <class Work> static bool guard(const Work& work)
    {
        try {
            work();
            return true;
        } catch (const std::exception& error) {
            note(error.what());
            return false;
        }
    }
};

} // namespace yade
