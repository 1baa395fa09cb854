// Boxes inside the tank that no phase enters: which cells they fill, and what is beside them.
//
// A cell of an obstacle holds nothing (f_s = alpha = 0) and all its faces are closed (aperture.hpp), so that
// nothing flows, and nothing is solved for, inside. What is left to say is that both phases stick to its
// surface: an edge there is half a cell from the velocity beside it, as on a wall of the tank. At re-entrant
// and outer corners of a box the distance stays a whole cell.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "solver/grid/for_each.hpp"
#include "solver/scene/box_cells.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

class Obstacles {
 public:
  // An edge of a plane (d, e), d < e, with obstacles beside it.
  struct Edge {
    std::array<int, 3> place{};            // of the edge, as Grid::edges counts them
    std::ptrdiff_t at = 0;                 // its index
    std::array<std::ptrdiff_t, 4> open{};  // cells around it that are none of an obstacle's, `cells` of them
    int cells = 0;
    // Along a flat surface: two open cells, and one open face between them.
    bool flat = false;
    int across = 0;        // then the direction across that surface,
    bool above = false;    // and whether the open cells are the upper ones along it
    bool on_side = false;  // of the tank, through which something flows: half of the edge is inside
    // The copy, at an upper seam, of one of the box above: the last cells have it beside them.
    bool copy = false;
    // Open faces around it: component and index, `faces` of them.
    std::array<std::pair<int, std::ptrdiff_t>, 4> face{};
    int faces = 0;
  };

  // Of the cells' part of the tank. `flows`: the sides of the tank through which something flows, two a
  // direction.
  Obstacles(const Layout& cells, int dim, const Vec3& spacing, const std::vector<Box>& boxes,
            const std::array<bool, 6>& flows);

  // There are none in the whole tank.
  bool none() const { return solid_.empty(); }
  // 1 in a cell of an obstacle, else 0; nullptr without obstacles. Ghosts included: beyond a side an
  // obstacle goes on.
  const char* solid() const { return none() ? nullptr : solid_.data(); }
  // Indices of their cells.
  const std::vector<std::ptrdiff_t>& cells() const { return cells_; }
  // Indices of their closed faces of direction d.
  const std::vector<std::ptrdiff_t>& faces(int d) const { return faces_[d]; }
  // Edges of a plane, by plane_index().
  const std::vector<Edge>& edges(int plane) const { return edges_[plane]; }
  // Gives cells at the surface the mean of the open cells beside them: for coefficients that are averaged
  // over the cells around an edge.
  void extend(double* values) const;

 private:
  struct Surface {
    std::ptrdiff_t cell = 0;
    std::vector<std::ptrdiff_t> beside;
  };
  void fill(const Layout& l, const BoxCells& box);
  void find_edges(const Layout& l, int d, int e, const std::array<bool, 6>& flows);
  void find_surface(const Layout& l, int dim);
  bool is_solid(std::ptrdiff_t c) const { return solid_[static_cast<std::size_t>(c)] != 0; }

  std::vector<char> solid_;
  std::vector<std::ptrdiff_t> cells_;
  std::array<std::vector<std::ptrdiff_t>, 3> faces_;
  std::array<std::vector<Edge>, 3> edges_;
  std::vector<Surface> surface_;
};

}  // namespace granvof
