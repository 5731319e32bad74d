// The list of verbs. A new verb is a file in verbs/ and an entry here.

#include "apps/verbs/all.hpp"
#include "apps/verbs/simulation.hpp"
#include "apps/verbs/study.hpp"

namespace whirl {

namespace {

const OptionSpec speeds{"speeds", "A:B:STEP", "speeds, such as 0:8000:50rpm"};

const OptionSpec over{"over", "PATH=A:B:STEP",
                      "a value of the model and what it runs over: first:last:step, first:last "
                      "with --points, or value,value,..."};
const OptionSpec frame{"frame", "F", "in which it repeats: stationary (the default)"};
const OptionSpec points{"points", "N", "how many values a range without a step has"};

std::vector<OptionSpec> with_integration(std::vector<OptionSpec> own) {
  own.insert(own.end(), integration_options().begin(), integration_options().end());
  return own;
}

}  // namespace

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all{
      {"check",
       "The model",
       "reads and checks a model, draws its layout",
       "MODEL",
       "whirl check models/two_disk_mac.toml",
       {},
       run_check},
      {"static",
       "The model",
       "sag under gravity and bearing loads",
       "MODEL",
       "whirl static models/two_disk_double_rub.toml",
       {},
       run_static},
      {"modes",
       "Linear rotordynamics",
       "complex modes at a speed",
       "MODEL",
       "whirl modes models/two_disk_mac.toml --speed 4430rpm",
       {{"modes", "N", "how many modes (8)"}},
       run_modes},
      {"campbell",
       "Linear rotordynamics",
       "modes followed over speeds, with the critical speeds",
       "MODEL",
       "whirl campbell models/two_disk_mac.toml --speeds 0:8000:50rpm",
       {{"modes", "N", "how many modes (8)"}, speeds},
       run_campbell},
      {"critical",
       "Linear rotordynamics",
       "critical speeds, directly",
       "MODEL",
       "whirl critical models/two_disk_mac.toml",
       {{"modes", "N", "how many critical speeds (6)"},
        {"order", "N", "excitation frequency over speed (1)"}},
       run_critical},
      {"unbalance",
       "Linear rotordynamics",
       "steady unbalance response over speeds",
       "MODEL",
       "whirl unbalance models/two_disk_mac.toml --speeds 0:8000:10rpm",
       {speeds, {"stations", "NAME,...", "names, node numbers or all (all)"}},
       run_unbalance},
      {"simulate", "Contact", "integrates in time, contacts and all", "MODEL",
       "whirl simulate models/two_disk_mac.toml --speed 4430rpm --out run.h5", with_integration({}),
       run_simulate},
      {"identify", "Contact", "says which complex modes make up the motion (MAC)", "MODEL",
       "whirl identify models/two_disk_mac.toml --out run.h5",
       with_integration(
           {{"modes", "N", "how many modes to compare with (8)"},
            {"rotations", "", "let tilts count too, times the rotor's length"},
            {"mass-weighted", "", "weight the MAC with the mass matrix"},
            {"stiffened", "", "modes of the rotor with its contacts closed for good"}}),
       run_identify},
      {"classify",
       "Contact",
       "tells the kind of the steady motion: periodic, quasi-periodic, chaotic",
       "MODEL",
       "whirl classify models/jeffcott_stator.toml --set contact.ring.friction=0.15",
       {{"revolutions", "N", "revolutions over which Lyapunov exponents are averaged (1000)"},
        discard_option,
        tolerance_option,
        from_option},
       run_classify},
      {"orbit",
       "Contact",
       "one periodic orbit, stable or not, with its Floquet multipliers",
       "MODEL",
       "whirl orbit models/jeffcott_stator.toml --period 1",
       {{"period", "N", "revolutions after which it repeats (1)"},
        frame,
        discard_option,
        tolerance_option,
        from_option},
       run_orbit},
      {"continue",
       "Contact",
       "a branch of periodic orbits along a parameter, round its folds, with its bifurcations",
       "MODEL",
       "whirl continue models/jeffcott_stator.toml --speed 138.4rad/s --set "
       "contact.ring.stiffness=64e6 --over contact.ring.friction=0.1:0.15:0.002 --at 0.15",
       {{"over", "PATH=A:B:STEP",
         "a value of the model, from where to where, and the largest step; first:last: a "
         "hundredth"},
        points,
        {"at", "VALUE", "where the first orbit is looked for, between first and last (first)"},
        {"period", "N", "revolutions after which the first orbit repeats (1)"},
        frame,
        {"switch", "N",
         "generations of branches that begin at period doublings and pitchforks (0)"},
        {"most", "N", "points of a branch at most (2000)"},
        {"stations", "NAME,...", "whose amplitude is said: names, node numbers, all (as sweep)"},
        discard_option,
        tolerance_option,
        from_option,
        {"restart", "", "begin anew, whatever the file of --out holds"}},
       run_continue},
      {"sweep", "Contact", "bifurcation diagram and spectra along one parameter, up and down",
       "MODEL",
       "whirl sweep models/jeffcott_stator.toml --over operation.speed=130:140:0.5rad/s --out "
       "sweep.h5",
       study_options({over,
                      points,
                      {"fresh", "", "every value from the model's start, not from the one before"},
                      {"sections", "N", "Poincare sections kept of a motion (64)"},
                      {"spectra", "N", "revolutions of a value's spectrum (32); 0: none"},
                      {"stations", "NAME,...",
                       "of sections and spectra: names, node numbers, all (contacts, disks, "
                       "bearings)"}}),
       run_sweep},
      {"map", "Contact", "a plane of two parameters, or several planes, every point classified",
       "MODEL",
       "whirl map models/jeffcott_stator.toml --over operation.speed=130:160:2rad/s --over "
       "contact.ring.stiffness=10:150:10MN/m --out map.h5",
       study_options({over, points}), run_map},
      {"basins", "Contact", "coexisting motions, and how much of the starts each attracts", "MODEL",
       "whirl basins models/jeffcott_stator.toml --set contact.ring.stiffness=50e6 --starts 500",
       study_options({{"starts", "N", "random starts around that of the model (256)"},
                      {"seed", "S", "of the random starts (1)"},
                      {"size", "R", "how far they are, in clearances (0.5)"},
                      {"over", "PATH=A:B:STEP",
                       "instead of random starts, values of the model's start: "
                       "start.displaced.1.x=-1:1:0.1mm"},
                      points}),
       run_basins},
      {"bench",
       "Contact",
       "speed against error of every integrator on this model",
       "MODEL",
       "whirl bench models/two_disk_mac.toml --methods dop853,rk4 --tolerances 1e-6,1e-10 --svg "
       "bench.svg",
       {{"revolutions", "N", "revolutions that are measured (20)"},
        discard_option,
        {"methods", "M,...", "integrators, as of simulate --method (all)"},
        {"tolerances", "T,...", "of their steps (1e-4,1e-6,1e-8,1e-10,1e-12)"},
        from_option,
        {"svg", "FILE", "picture of time over error, both logarithmic"}},
       run_bench},
      {"export",
       "Results",
       "a result or a model to other programs",
       "FILE",
       "whirl export run.h5 --format vtk --out run",
       {{"format", "F",
         "vtk: series for ParaView (the default); xdmf: longer ones; csv: tables; vtu; with meshio "
         "abaqus, nastran, gmsh, exodus, "
         "med, stl, ..."},
        {"out", "NAME", "where the files go, without an ending; left out: beside FILE"},
        {"revolutions", "N", "last revolutions of a motion (4; xdmf: 64)"},
        {"frames", "N", "frames of a motion at most (128; xdmf: all)"},
        {"modes", "N", "mode shapes (4)"}},
       run_export},
      {"report",
       "Results",
       "one HTML page with every figure of a result",
       "RESULT.h5",
       "whirl report run.h5 --out run.html",
       {{"out", "FILE.html", "the page; left out: beside the result"}},
       run_report,
       "OTHER.h5",
       "further results on the same page"},
      {"plot",
       "Results",
       "one figure of a result, ready for a paper",
       "RESULT.h5",
       "whirl plot run.h5 orbit --out orbit.svg",
       {{"out", "FILE", "picture, .svg, .png or .pdf; left out: .svg beside the result"},
        {"which", "NAME", "of several of a kind: the station, contact or plane (the first)"}},
       run_plot,
       "KIND",
       "what to draw; left out: lists what the result holds"},
  };
  return all;
}

}  // namespace whirl
