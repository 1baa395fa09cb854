#include "solver/operators/friction_direct_of_slabs.hpp"

#include <algorithm>
#include <span>

#include "solver/grid/slabs.hpp"

namespace granvof {

FrictionDirectOfSlabs::FrictionDirectOfSlabs(const Grid& grid, const Scene& scene)
    : grid_(grid), whole_(scene), direct_(whole_) {
  const int size = grid.cells.communicator->size();
  for (int rank = 0; rank < size; ++rank) {
    const Slab own = slab(whole_.cells.n[0], size, rank);
    columns_.push_back({own.first, own.rows + (rank + 1 == size ? 1 : 0)});
  }
  for (int i = 0; i < 2; ++i) correction_.emplace_back(whole_);
}

// Every process does all of it, where iterations are shared. By the faces of each column, as long as the rows
// of the matrix are: the envelope itself is known only once all have the whole.
bool FrictionDirectOfSlabs::is_thin(const Range& box, const FrictionForm& form) const {
  const double *m = form.marked[0], *w = form.marked[1];
  std::array<double, 2> sums{};
  for (int i = 0; i < grid_.cells.n[0]; ++i) {
    double faces = 0.0;
    for (int j = box.lower[1]; j <= box.upper[1]; ++j) {
      const std::ptrdiff_t c = grid_.cells.index(i, j, 0);
      faces += (j < box.upper[1] && m[c] != 0.0 ? 1.0 : 0.0) + (w[c] != 0.0 ? 1.0 : 0.0);
    }
    sums[0] += faces * faces * faces;
    sums[1] += faces;
  }
  grid_.cells.communicator->sum(sums);
  return sums[0] * grid_.cells.communicator->size() <= FrictionDirect::longest_rows * sums[1];
}

void FrictionDirectOfSlabs::collect(const std::vector<const double*>& parts) {
  const Communicator& processes = *grid_.cells.communicator;
  const Columns& own = columns_[static_cast<std::size_t>(processes.rank())];
  const std::size_t rows = static_cast<std::size_t>(box_.upper[1] - box_.lower[1] + 1) * parts.size();
  std::vector<std::size_t> sizes;
  std::size_t total = 0;
  for (const Columns& c : columns_) {
    sizes.push_back(rows * static_cast<std::size_t>(c.count) * sizeof(double));
    total += rows * static_cast<std::size_t>(c.count);
  }
  mine_.clear();
  for (const double* part : parts)
    for (int j = box_.lower[1]; j <= box_.upper[1]; ++j) {
      const double* row = part + grid_.cells.index(0, j, 0);
      mine_.insert(mine_.end(), row, row + own.count);
    }
  all_.resize(total);
  processes.gather(std::as_bytes(std::span(mine_)), sizes, std::as_writable_bytes(std::span(all_)), true);
  while (whole_values_.size() < parts.size()) whole_values_.emplace_back(whole_);
  const double* in = all_.data();
  for (const Columns& c : columns_)
    for (std::size_t n = 0; n < parts.size(); ++n)
      for (int j = box_.lower[1]; j <= box_.upper[1]; ++j, in += c.count)
        std::copy_n(in, c.count, whole_values_[n].data() + whole_.cells.index(c.first, j, 0));
}

bool FrictionDirectOfSlabs::factorise(const Range& box, const FrictionForm& form) {
  if (whole_.dim != 2 || whole_.cells.any_seam() || !is_thin(box, form)) return false;
  box_ = box;
  box_.upper[0] = whole_.cells.n[0];
  std::vector<const double*> parts{form.mu[0],     form.mu[1],     form.lambda,  form.edge,
                                   form.marked[0], form.marked[1], form.mass[0], form.mass[1]};
  if (form.tilting != nullptr) parts.push_back(form.tilting);
  collect(parts);
  const auto whole = [&](std::size_t n) -> const double* { return whole_values_[n].data(); };
  return direct_.factorise(box_, {{whole(0), whole(1)},
                                  whole(2),
                                  whole(3),
                                  form.tilting != nullptr ? whole(8) : nullptr,
                                  {whole(4), whole(5)},
                                  {whole(6), whole(7)}});
}

void FrictionDirectOfSlabs::apply(const linear::ConstComponents& r, const linear::Components& z) {
  collect({r[0], r[1]});
  const std::array<const Field*, 2> of_whole{&whole_values_[0], &whole_values_[1]};
  direct_.apply({of_whole[0]->data(), of_whole[1]->data(), nullptr},
                {correction_[0].data(), correction_[1].data(), nullptr});
  const Columns& own = columns_[static_cast<std::size_t>(grid_.cells.communicator->rank())];
  for (std::size_t d = 0; d < 2; ++d)
    for (int j = box_.lower[1]; j < box_.upper[1] + (d == 1 ? 1 : 0); ++j)
      std::copy_n(correction_[d].data() + whole_.cells.index(own.first, j, 0),
                  d == 0 ? own.count : grid_.cells.n[0], z[d] + grid_.cells.index(0, j, 0));
}

}  // namespace granvof
