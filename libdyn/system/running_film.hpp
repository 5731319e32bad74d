#pragma once
/// A journal that runs on its oil film, as a result: its place, and the film at that place.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/system/film.hpp"

namespace whirl::inline dyn {

/// Coefficients of a film in a plane.
struct PlaneCoefficients {
  double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;

  explicit PlaneCoefficients(const Mat2& A) : xx(A(0, 0)), xy(A(0, 1)), yx(A(1, 0)), yy(A(1, 1)) {}

  static constexpr auto columns() {
    using P = PlaneCoefficients;
    return ColumnList{column("xx", &P::xx, "", "force along x by a motion along x"),
                      column("xy", &P::xy, "", "force along x by a motion along y"),
                      column("yx", &P::yx, "", "force along y by a motion along x"),
                      column("yy", &P::yy, "", "force along y by a motion along y")};
  }
};

/// A journal on its film in static equilibrium.
struct RunningFilm {
  std::string name;
  Vec2 place = Vec2::Zero();      ///< displacement from the middle of the bearing [m]
  Vec2 load = Vec2::Zero();       ///< of the journal on the film [N]
  double eccentricity = 0.0;      ///< over the clearance
  double attitude = 0.0;          ///< from the load to the place, > 0 about +z [rad]; NaN: no load
  double thickness = 0.0;         ///< least, of the film [m]
  double sommerfeld = 0.0;        ///< NaN: no load, or the film is not dragged
  double power_loss = 0.0;        ///< by shear all around the journal [W]
  Mat2 stiffness = Mat2::Zero();  ///< force = -K u - C u' about the place [N/m]
  Mat2 damping = Mat2::Zero();    ///< [N.s/m]

  double attitude_deg() const;
  double fx() const { return load(0); }
  double fy() const { return load(1); }
  PlaneCoefficients stiffness_parts() const { return PlaneCoefficients(stiffness); }
  PlaneCoefficients damping_parts() const { return PlaneCoefficients(damping); }

  static constexpr auto columns() {
    using enum Written;
    using R = RunningFilm;
    return ColumnList{
        column("name", &R::name, "", "oil film").axis(),
        column("eccentricity", &R::eccentricity, "", "of the journal over the clearance"),
        column("attitude", &R::attitude, "rad", "from the load to the journal, > 0 about +z")
            .only(in_file),
        column("attitude_deg", &R::attitude_deg, "", "from the load to the journal, > 0 about +z")
            .only(in_json),
        column("film", &R::thickness, "m", "least thickness of the film"),
        column("sommerfeld", &R::sommerfeld, "", "Sommerfeld number"),
        column("power_loss", &R::power_loss, "W", "power that shear takes"),
        column("place", &R::place, "m", "displacement from the middle of the bearing (x, y)")
            .along("2")
            .only(in_file),
        column("load", &R::load, "N", "force of the journal on the film (x, y)")
            .along("2")
            .only(in_file),
        column("fx", &R::fx, "N", "force of the journal on the film").only(in_json),
        column("fy", &R::fy, "N", "force of the journal on the film").only(in_json),
        column("stiffness", &R::stiffness, "N/m", "stiffness about the place")
            .along("2 2")
            .only(in_file),
        column("damping", &R::damping, "N.s/m", "damping about the place")
            .along("2 2")
            .only(in_file),
        column("stiffness", &R::stiffness_parts, "", "stiffness about the place").only(in_json),
        column("damping", &R::damping_parts, "", "damping about the place").only(in_json)};
  }
};

/// Journals on all films of a rotor, as a group of a result file.
struct RunningFilms {
  std::vector<RunningFilm> films;

  static constexpr std::string_view group = "/films";
  static constexpr auto columns() { return ColumnList{rows(&RunningFilms::films, "films")}; }
};

/// The film of a journal at a place, a displacement from the middle of its bearing [m].
///
///   S = viscosity N (2 R) L / W (R / c)^2,   N = |Omega| / 2 pi
///   P = |Omega| (2 pi viscosity |Omega| R^3 L / (c sqrt(1 - e^2)) + |place x load| / 2)
///
/// P is the loss of a film that is full all around: it is not less where a real film is not full.
///
/// @source [PinkusSternlicht1961]
/// @param drag  as drag_speed() says [rad/s]
RunningFilm running_film(const OilFilm& film, double Omega, const Vec2& place, double drag);
/// The same of a bearing that stands.
inline RunningFilm running_film(const OilFilm& film, double Omega, const Vec2& place) {
  return running_film(film, Omega, place, Omega);
}

}  // namespace whirl::inline dyn
