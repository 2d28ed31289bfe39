// SPDX-License-Identifier: GPL-2.0-or-later
#include "Problems.hpp"

#include <stdexcept>

namespace yade {
namespace {
    std::mutex access;
    std::string first;
} // namespace

void Problems::note(const std::string& sentence)
{
    const std::lock_guard<std::mutex> lock(access);
    if (first.empty()) first = sentence;
}

void Problems::raise()
{
    std::string sentence;
    {
        const std::lock_guard<std::mutex> lock(access);
        sentence.swap(first);
    }
    if (!sentence.empty()) throw std::runtime_error(sentence);
}

} // namespace yade
