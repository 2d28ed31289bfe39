// SPDX-License-Identifier: GPL-2.0-or-later
// Reads a contact problem and its solution, or its guesses, with libfclib and writes them to another file with it.
//
//   fclib_copy FROM TO solution|guesses
extern "C" {
#include <fclib.h>
}

#include <cstring>

int main(int, char** arguments)
{
    const char *const from = arguments[1], *const to = arguments[2];
    const bool solved = !std::strcmp(arguments[3], "solution");
    fclib_local* const problem = fclib_read_local(from);
    int count = 1;
    fclib_solution* const answers = solved ? fclib_read_solution(from) : fclib_read_guesses(from, &count);
    if (!problem || !answers || !fclib_write_local(problem, to)) return 1;
    return (solved ? fclib_write_solution(answers, to) : fclib_write_guesses(count, answers, to)) ? 0 : 1;
}
