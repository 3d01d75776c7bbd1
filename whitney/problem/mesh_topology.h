// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/cells/cell_complex.h>
#include <whitney/problem/budget.h>
#include <whitney/problem/report.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// Fills report.topology and topology_level: as much of the level asked for as the budget allows, the rest noted as
/// left out. With kCells the f-vector is that of the complex.
void report_topology(const SimplicialMesh& mesh, TopologyLevel level, Budget& budget, Report& report);

/// The mesh of a complex is a polygon mesh: the f-vector is that of its cells.
void count_cells(const CellComplex& complex, Report& report);

}  // namespace whitney
