//! Binary PLY files.

use crate::build::Mesh;
use std::io::{self, Write};

/// Writes a mesh, with normals and texture coordinates when it has them.
pub(super) fn write(out: &mut impl Write, mesh: &Mesh) -> io::Result<()> {
    let smooth = !mesh.normals.is_empty();
    writeln!(out, "ply\nformat binary_little_endian 1.0\nelement vertex {}", mesh.positions.len())?;
    let normal_axes: &[&str] = if smooth { &["nx", "ny", "nz"] } else { &[] };
    let uv_axes: &[&str] = if mesh.uvs.is_empty() { &[] } else { &["u", "v"] };
    for axis in ["x", "y", "z"].iter().chain(normal_axes).chain(uv_axes) {
        writeln!(out, "property float {axis}")?;
    }
    writeln!(out, "element face {}", mesh.triangles.len())?;
    writeln!(out, "property list uchar int vertex_indices\nend_header")?;
    for (i, p) in mesh.positions.iter().enumerate() {
        p.to_array().iter().try_for_each(|c| out.write_all(&c.to_le_bytes()))?;
        if let Some(n) = mesh.normals.get(i) {
            n.to_array().iter().try_for_each(|c| out.write_all(&c.to_le_bytes()))?;
        }
        if let Some(uv) = mesh.uvs.get(i) {
            uv.to_array().iter().try_for_each(|c| out.write_all(&c.to_le_bytes()))?;
        }
    }
    for t in &mesh.triangles {
        out.write_all(&[3])?;
        t.iter().try_for_each(|i| out.write_all(&i.to_le_bytes()))?;
    }
    Ok(())
}
