// SPDX-License-Identifier: GPL-2.0-or-later
#include "grid/surface_operator.hpp"

namespace softgrain {

template <int Dim> void SurfaceOperator<Dim>::build(const std::vector<Row>& rows, const std::vector<double>& node_mass)
{
    const int n = int(rows.size());
    std::vector<double> scaled(node_mass.size(), 0), dense(size_t(n) * n, 0); // a row over the masses; all of D
    delassus_row.assign(1, 0);
    delassus_column.clear();
    delassus_value.clear();
    for (int p = 0; p < n; ++p) {
        for (const auto& [node, weight] : rows[p])
            scaled[node] = weight / node_mass[node];
        for (int q = 0; q < n; ++q) {
            double value = 0;
            for (const auto& [node, weight] : rows[q])
                value += weight * scaled[node];
            if (value == 0) continue;
            dense[size_t(p) * n + q] = value;
            delassus_column.push_back(q);
            delassus_value.push_back(value);
        }
        delassus_row.push_back(int(delassus_column.size()));
        for (const auto& entry : rows[p])
            scaled[entry.first] = 0;
    }
    face_rows.resize(n);
    for (int segment = 0; segment < n; ++segment) {
        FaceRows& face = face_rows[segment];
        std::array<const double*, face_vertices<Dim>> vertex;
        for (int k = 0; k < face_vertices<Dim>; ++k) {
            vertex[k] = &dense[size_t((segment + n - 1 + k) % n) * n];
            face.value[k].clear();
        }
        face.column.clear();
        for (int q = 0; q < n; ++q) {
            bool any = false;
            for (const double* row : vertex)
                any |= row[q] != 0;
            if (!any) continue;
            face.column.push_back(q);
            for (int k = 0; k < face_vertices<Dim>; ++k)
                face.value[k].push_back(vertex[k][q]);
        }
    }
}

template <int Dim> double SurfaceOperator<Dim>::delassus(int row, int column) const
{
    for (int k = delassus_row[row]; k < delassus_row[row + 1]; ++k)
        if (delassus_column[k] == column) return delassus_value[k];
    return 0;
}

template struct SurfaceOperator<2>;

} // namespace softgrain
