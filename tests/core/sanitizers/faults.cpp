// SPDX-License-Identifier: GPL-2.0-or-later
// Faults that the sanitizers have to report, and threads that meet as those of the core do, which they have to let pass.
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace {

void overrun(int count)
{
    std::vector<double> values(count);
    const double* end = values.data() + values.size();
    std::printf("%g\n", *end);
}

void overflow(int count) { std::printf("%d\n", std::numeric_limits<int>::max() + count); }

void race(int count)
{
    int sum = 0;
#pragma omp parallel for num_threads(3) schedule(static)
    for (int i = 0; i < count; ++i)
        sum += i;
    std::printf("%d\n", sum);
}

void team(int count)
{
    std::vector<int> values(count), sums(count);
    bool done = false;
    int rounds = 0;
#pragma omp parallel num_threads(3)
    while (!done) {
#pragma omp for schedule(static, 1)
        for (int i = 0; i < count; ++i)
            values[i] += i;
#pragma omp for schedule(dynamic)
        for (int i = 0; i < count; ++i)
            sums[i] += values[count - 1 - i];
#pragma omp single
        done = ++rounds == 100;
    }
    std::printf("%d\n", sums[0]);
}

} // namespace

int main(int words, char** word)
{
    const std::string name = words > 1 ? word[1] : "";
    const int count = 100 * words;
    if (name == "overrun") overrun(count);
    if (name == "overflow") overflow(count);
    if (name == "race") race(count);
    if (name == "team") team(count);
}
