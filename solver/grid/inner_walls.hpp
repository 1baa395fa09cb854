// Walls inside the tank: the closed faces of obstacles, which both phases stick to, and those of the gate, a
// plate along which both slip.
//
// On the sides of the tank ghosts say what those see who look past them (boundary.hpp). Beyond a closed face
// inside lies an obstacle that holds nothing, or another body of fluid, and neither is to be seen from here.
// Operators that look further than their own faces take what they see from here, by the same rule: a scalar
// goes on as in the last cell before the wall; of a velocity, a component along the wall is mirrored (turned
// round where the phase sticks to it), and one across it is turned round.
#pragma once

#include <array>
#include <vector>

#include "solver/grid/grid.hpp"

namespace granvof {

class InnerWalls {
 public:
  // Values at five places in a row; one looks from the middle one.
  using Line = std::array<double, 5>;

  struct Place {
    std::array<int, 3> place{};
    std::ptrdiff_t at = 0;  // its index
  };
  // An edge along a wall, no end of one.
  struct Edge : Place {
    double share = 0.0;  // what a difference of velocities across it is to be taken times: 2 where both
                         // phases stick to it, half a cell away, 0 where they slip
  };

  explicit InnerWalls(const Grid& grid);
  // The gate: faces x of index `face` in the whole tank, closed from `open_rows` up.
  void shut_gate(int face, int open_rows);

  bool none() const { return closed_[0].empty(); }
  // Open faces of direction d from which a wall is in sight: two steps away across it or along it, one step
  // along d itself.
  const std::vector<Place>& faces(int d) const { return faces_[d]; }
  // Faces of direction d that are walls.
  const std::vector<Place>& closed_faces(int d) const { return closed_faces_[d]; }
  // Cells beside a wall, across edges and corners too; the first beyond a lower seam among them, which give
  // to the faces on it.
  const std::vector<Place>& cells() const { return cells_; }
  // Edges on a wall, of the plane with plane_index().
  const std::vector<Edge>& edges(int plane) const { return edges_[plane]; }

  // A scalar in two cells on either side of open face c of direction d; the third is cell c.
  std::array<double, 4> cells_across(const double* v, std::ptrdiff_t c, int d) const;
  // A scalar one step from cell c, each of `step` in {-1, 0, 1}: in whichever order one goes, the mean of
  // all.
  double cell_beside(const double* v, std::ptrdiff_t c, const std::array<int, 3>& step) const;
  // Component d of a velocity along direction e as seen from its open face c.
  Line faces_along(const double* v, std::ptrdiff_t c, int d, int e) const;

 private:
  bool is_closed(int d, std::ptrdiff_t face) const { return closed_[d][static_cast<std::size_t>(face)] != 0; }
  bool is_solid(std::ptrdiff_t cell) const { return solid_ != nullptr && solid_[cell] != 0; }
  // A wall between face c of direction d and the next one along e, upwards or downwards.
  bool wall_between(std::ptrdiff_t c, int d, int e, bool up) const;
  double share_across(std::ptrdiff_t c, int d, int e, bool up) const;
  bool in_sight(std::ptrdiff_t c, int d) const;
  bool beside_wall(std::ptrdiff_t c) const;
  // Of the places in `near`, outside of which no wall is in sight.
  void list(const Range& near);
  void list_edges(int d, int e, const Range& near);

  const Grid& grid_;
  const char* solid_;  // cells of obstacles, null without
  std::array<std::vector<char>, 3> closed_;
  std::array<std::vector<Place>, 3> faces_, closed_faces_;
  std::array<std::vector<Edge>, 3> edges_;
  std::vector<Place> cells_;
};

}  // namespace granvof
