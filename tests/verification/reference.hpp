// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace softgrain::testing_support {

/// A table of reference/: comment lines, a line of names, rows. Entries that are no numbers are kept apart as words.
class Table {
public:
    explicit Table(const std::string& name)
    {
        std::ifstream file(std::string(SOFTGRAIN_REFERENCE) + "/" + name);
        if (!file) throw std::runtime_error("no reference table " + name);
        std::vector<std::string> names;
        for (std::string line; std::getline(file, line);) {
            if (line.empty() || line[0] == '#') continue;
            std::vector<std::string> fields;
            std::stringstream row(line);
            for (std::string field; std::getline(row, field, ',');)
                fields.push_back(field);
            if (names.empty()) {
                names = fields;
                continue;
            }
            for (size_t k = 0; k < names.size(); ++k) {
                std::istringstream entry(fields.at(k));
                double value;
                if (entry >> value) numbers_[names[k]].push_back(value);
                else words_[names[k]].push_back(fields[k]);
            }
        }
    }

    const std::vector<double>& operator[](const std::string& name) const { return numbers_.at(name); }
    const std::vector<std::string>& words(const std::string& name) const { return words_.at(name); }

    /// Linear between the rows.
    double at(const std::string& key, double place, const std::string& name) const
    {
        const auto &x = numbers_.at(key), &y = numbers_.at(name);
        size_t k = 1;
        while (k + 1 < x.size() && x[k] < place)
            ++k;
        return y[k - 1] + (y[k] - y[k - 1]) * (place - x[k - 1]) / (x[k] - x[k - 1]);
    }

private:
    std::map<std::string, std::vector<double>> numbers_;
    std::map<std::string, std::vector<std::string>> words_;
};

} // namespace softgrain::testing_support
