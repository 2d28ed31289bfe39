// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
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
                if (entry >> value)
                    numbers_[names[k]].push_back(value);
                else
                    words_[names[k]].push_back(fields[k]);
            }
        }
    }

    /// The rows where this column has this value.
    Table where(const std::string& name, double value) const
    {
        Table part;
        const auto& column = numbers_.at(name);
        for (const auto& [other, values] : numbers_)
            for (size_t i = 0; i < column.size(); ++i)
                if (column[i] == value) part.numbers_[other].push_back(values.at(i));
        return part;
    }

    const std::vector<double>& operator[](const std::string& name) const { return numbers_.at(name); }
    const std::vector<std::string>& words(const std::string& name) const { return words_.at(name); }

    /// Cubic through the two rows on either side. Straight lines between forces 1 % of squeeze apart are off by 0.2 %.
    double at(const std::string& key, double place, const std::string& name) const
    {
        const auto &x = numbers_.at(key), &y = numbers_.at(name);
        size_t after = 1;
        while (after + 1 < x.size() && x[after] < place)
            ++after;
        const size_t first = std::min(std::max<size_t>(after, 2) - 2, x.size() - 4);
        double sum = 0;
        for (size_t i = first; i < first + 4; ++i) {
            double weight = 1;
            for (size_t j = first; j < first + 4; ++j)
                if (j != i) weight *= (place - x[j]) / (x[i] - x[j]);
            sum += weight * y[i];
        }
        return sum;
    }

private:
    Table() = default;

    std::map<std::string, std::vector<double>> numbers_;
    std::map<std::string, std::vector<std::string>> words_;
};

} // namespace softgrain::testing_support
