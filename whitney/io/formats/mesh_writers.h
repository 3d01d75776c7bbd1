// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <whitney/io/atomic_file.h>
#include <whitney/io/formats/mesh_view.h>

namespace whitney::io {

// One writer per format. Each may rely on the checks of write_mesh: the format holds this kind of mesh.
void write_noff(AtomicFile& file, const MeshView& mesh);
void write_off(AtomicFile& file, const MeshView& mesh);
void write_ply(AtomicFile& file, const MeshView& mesh);
void write_obj(AtomicFile& file, const MeshView& mesh);
void write_stl(AtomicFile& file, const MeshView& mesh);
void write_vtu(AtomicFile& file, const MeshView& mesh);
void write_medit(AtomicFile& file, const MeshView& mesh);
void write_pov(AtomicFile& file, const MeshView& mesh);

}  // namespace whitney::io
