#include "reference/demvof/fluid/box_mesh.hpp"

namespace demvof {

namespace {

using Foam::face;
using Foam::label;

// Labels of points and cells of the box; closed cells have none.
struct Box {
  label nx, ny, nz;
  Foam::labelList labels{};  // by place in the tank
  label point(label i, label j, label k) const { return (k * (ny + 1) + j) * (nx + 1) + i; }
  label place(label i, label j, label k) const { return (k * ny + j) * nx + i; }
  label cell(label i, label j, label k) const { return labels[place(i, j, k)]; }
  bool open(label i, label j, label k) const { return cell(i, j, k) >= 0; }
};

face quad(label a, label b, label c, label d) {
  face f(4);
  f[0] = a;
  f[1] = b;
  f[2] = c;
  f[3] = d;
  return f;
}

// Faces whose normal points along +x, +y, +z, seen from the cell below them.
face x_face(const Box& b, label i, label j, label k) {
  return quad(b.point(i, j, k), b.point(i, j + 1, k), b.point(i, j + 1, k + 1), b.point(i, j, k + 1));
}
face y_face(const Box& b, label i, label j, label k) {
  return quad(b.point(i, j, k), b.point(i, j, k + 1), b.point(i + 1, j, k + 1), b.point(i + 1, j, k));
}
face z_face(const Box& b, label i, label j, label k) {
  return quad(b.point(i, j, k), b.point(i + 1, j, k), b.point(i + 1, j + 1, k), b.point(i, j + 1, k));
}

}  // namespace

Foam::labelList places_of_cells(const FluidSettings& s) {
  Foam::DynamicList<label> places;
  for (label place = 0; place < s.cells[0] * s.cells[1] * s.cells[2]; ++place) {
    if (s.obstacles.empty() || s.obstacles[static_cast<std::size_t>(place)] == 0) places.append(place);
  }
  Foam::labelList list;
  list.transfer(places);
  return list;
}

std::unique_ptr<Foam::fvMesh> make_box_mesh(const FluidSettings& s, const Foam::Time& time) {
  Box b{s.cells[0], s.cells[1], s.cells[2]};
  b.labels = Foam::labelList(b.nx * b.ny * b.nz, -1);
  const Foam::labelList places(places_of_cells(s));
  forAll(places, cell) b.labels[places[cell]] = cell;

  Foam::pointField points((b.nx + 1) * (b.ny + 1) * (b.nz + 1));
  for (label k = 0; k <= b.nz; ++k)
    for (label j = 0; j <= b.ny; ++j)
      for (label i = 0; i <= b.nx; ++i)
        points[b.point(i, j, k)] = Foam::point(i * s.spacing[0], j * s.spacing[1], k * s.spacing[2]);

  Foam::DynamicList<face> faces, at_obstacles;
  Foam::DynamicList<label> owner, neighbour, owner_at_obstacles;
  // Inner faces in OpenFOAM's upper-triangular order: by owner, then by neighbour.
  for (label k = 0; k < b.nz; ++k)
    for (label j = 0; j < b.ny; ++j)
      for (label i = 0; i < b.nx; ++i) {
        const auto add = [&](const face& f, label other) {
          const label here = b.cell(i, j, k);
          if (here >= 0 && other >= 0) {
            faces.append(f);
            owner.append(here);
            neighbour.append(other);
          } else if (here >= 0 || other >= 0) {
            at_obstacles.append(here >= 0 ? f : f.reverseFace());
            owner_at_obstacles.append(here >= 0 ? here : other);
          }
        };
        if (i + 1 < b.nx) add(x_face(b, i + 1, j, k), b.cell(i + 1, j, k));
        if (j + 1 < b.ny) add(y_face(b, i, j + 1, k), b.cell(i, j + 1, k));
        if (k + 1 < b.nz) add(z_face(b, i, j, k + 1), b.cell(i, j, k + 1));
      }
  const label inner = faces.size();

  label start[6], size[6];
  for (int side = 0; side < 6; ++side) {
    start[side] = faces.size();
    const int d = side / 2;
    const bool upper = side % 2 == 1;
    const label n[3] = {d == 0 ? 1 : b.nx, d == 1 ? 1 : b.ny, d == 2 ? 1 : b.nz};
    for (label k = 0; k < n[2]; ++k)
      for (label j = 0; j < n[1]; ++j)
        for (label i = 0; i < n[0]; ++i) {
          const label x = d == 0 && upper ? b.nx : i, y = d == 1 && upper ? b.ny : j,
                      z = d == 2 && upper ? b.nz : k;
          const face f = d == 0 ? x_face(b, x, y, z) : d == 1 ? y_face(b, x, y, z) : z_face(b, x, y, z);
          const label last[3] = {d == 0 && upper ? b.nx - 1 : i, d == 1 && upper ? b.ny - 1 : j,
                                 d == 2 && upper ? b.nz - 1 : k};
          if (!b.open(last[0], last[1], last[2])) continue;
          faces.append(upper ? f : f.reverseFace());
          owner.append(b.cell(last[0], last[1], last[2]));
        }
    size[side] = faces.size() - start[side];
  }
  const label first_at_obstacles = faces.size();
  faces.append(at_obstacles);
  owner.append(owner_at_obstacles);

  Foam::faceList face_list;
  Foam::labelList owner_list, neighbour_list;
  face_list.transfer(faces);
  owner_list.transfer(owner);
  neighbour_list.transfer(neighbour);
  if (neighbour_list.size() != inner) throw std::runtime_error("box mesh: inner faces do not match");
  auto mesh = std::make_unique<Foam::fvMesh>(
      Foam::IOobject("region0", time.timeName(), time, Foam::IOobject::READ_IF_PRESENT), std::move(points),
      std::move(face_list), std::move(owner_list), std::move(neighbour_list));

  const char* const names[6] = {"left", "right", "bottom", "top", "front", "back"};
  Foam::List<Foam::polyPatch*> patches(s.obstacles.empty() ? 6 : 7);
  for (int side = 0; side < 6; ++side) {
    const char* type = s.sides[side] == FluidSide::empty  ? "empty"
                       : s.sides[side] == FluidSide::open ? "patch"
                                                          : "wall";
    patches[side] =
        Foam::polyPatch::New(type, names[side], size[side], start[side], side, mesh->boundaryMesh()).ptr();
  }
  if (!s.obstacles.empty()) {
    patches[6] = Foam::polyPatch::New("wall", "obstacles", at_obstacles.size(), first_at_obstacles, 6,
                                      mesh->boundaryMesh())
                     .ptr();
  }
  mesh->addFvPatches(patches);
  return mesh;
}

}  // namespace demvof
