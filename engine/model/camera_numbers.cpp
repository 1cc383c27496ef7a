#include "engine/model/camera_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace palace {
namespace {

constexpr double kLargestSide = 65536;

/// Visits every field of a camera, once for both directions. `Visitor` takes numbers, whole numbers
/// from 0 to a limit, and vectors.
template <typename Visitor>
void VisitCahvor(Visitor& visit, CahvorModel& m) {
  visit.Whole(m.width, kLargestSide);
  visit.Whole(m.height, kLargestSide);
  for (Eigen::Vector3d* v : {&m.C, &m.A, &m.H, &m.V, &m.O, &m.R}) {
    visit.Many(v->data(), 3);
  }
}

template <typename Visitor>
void VisitLens(Visitor& visit, CahvorModel& m) {
  VisitCahvor(visit, m);
}

template <typename Visitor>
void VisitLens(Visitor& visit, CahvoreModel& m) {
  VisitCahvor(visit, m.base);
  visit.Many(m.E.data(), 3);
  visit.Many(&m.linearity, 1);
}

template <typename Visitor>
void VisitLens(Visitor& visit, TsaiModel& m) {
  visit.Whole(m.width, kLargestSide);
  visit.Whole(m.height, kLargestSide);
  for (double* value : {&m.sensor_columns, &m.frame_columns, &m.dx, &m.dy, &m.dpx, &m.dpy, &m.Cx_px,
                        &m.Cy_px, &m.sx, &m.f, &m.kappa1}) {
    visit.Many(value, 1);
  }
  visit.Many(m.T.data(), 3);
  for (double* value : {&m.Rx_rad, &m.Ry_rad, &m.Rz_rad}) {
    visit.Many(value, 1);
  }
}

template <typename Visitor>
void VisitLens(Visitor& visit, OpenCvModel& m) {
  visit.Whole(m.pinhole.width, kLargestSide);
  visit.Whole(m.pinhole.height, kLargestSide);
  for (double* value : {&m.pinhole.fx_px, &m.pinhole.fy_px, &m.pinhole.cx_px, &m.pinhole.cy_px}) {
    visit.Many(value, 1);
  }
  int lens = static_cast<int>(m.lens);
  visit.Whole(lens, 1);
  m.lens = static_cast<OpenCvLens>(lens);
  visit.Whole(m.coefficients, static_cast<double>(m.k.size()));
  visit.Many(m.k.data(), m.k.size());
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R_CF = m.R_CF;
  visit.Many(R_CF.data(), 9);
  m.R_CF = R_CF;
  visit.Many(m.t_CF.data(), 3);
}

template <typename Visitor>
void VisitModel(Visitor& visit, CameraModel& model) {
  visit.Many(&model.unit_m, 1);
  int pose = model.pose_is_known ? 1 : 0;
  visit.Whole(pose, 1);
  model.pose_is_known = pose == 1;
  std::visit([&](auto& lens) { VisitLens(visit, lens); }, model.lens);
}

class Writer {
 public:
  explicit Writer(std::vector<double>& row) : row_(row) {}
  void Many(const double* values, std::size_t count) {
    row_.insert(row_.end(), values, values + count);
  }
  void Whole(const int& value, double) { row_.push_back(value); }

 private:
  std::vector<double>& row_;
};

class Reader {
 public:
  explicit Reader(const std::vector<double>& row) : row_(row) {}
  void Many(double* values, std::size_t count) {
    if (row_.size() - at_ < count) {
      good_ = false;
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      values[i] = row_[at_++];
      good_ = good_ && std::isfinite(values[i]);
    }
  }
  void Whole(int& value, double greatest) {
    double number = 0;
    Many(&number, 1);
    good_ = good_ && number >= 0 && number <= greatest && number == std::floor(number);
    value = good_ ? static_cast<int>(number) : 0;
  }
  bool Finished() const { return good_ && at_ == row_.size(); }

 private:
  const std::vector<double>& row_;
  std::size_t at_ = 0;
  bool good_ = true;
};

}  // namespace

std::vector<double> NumbersOf(const CameraModel& model) {
  std::vector<double> row = {static_cast<double>(model.lens.index())};
  CameraModel copy = model;  // the visitor serves reading as well
  Writer writer(row);
  VisitModel(writer, copy);
  return row;
}

std::optional<CameraModel> CameraFromNumbers(const std::vector<double>& row) {
  CameraModel model;
  Reader reader(row);
  int family = 0;
  reader.Whole(family, 3);
  if (family == 1) {
    model.lens = CahvoreModel{};
  } else if (family == 2) {
    model.lens = TsaiModel{};
  } else if (family == 3) {
    model.lens = OpenCvModel{};
  }
  VisitModel(reader, model);
  return reader.Finished() && model.unit_m > 0 ? std::optional<CameraModel>(model) : std::nullopt;
}

}  // namespace palace
