/* Help of commands that is a page of its own. */
#ifndef VERIFY_HELP_H
#define VERIFY_HELP_H

#define VERIFY_JUDGE_HELP                                                                                              \
    "Compares results of any solver with an exact solution, at the results' own points and time; it\n"                 \
    "interpolates nothing. The oracle has to prove itself first. Prints errors by level, observed orders and\n"        \
    "gates; writes them as --json FILE and, with --out DIR, as report.html and report.json.\n"                         \
    "\n"                                                                                                               \
    "  assay judge fine.h5 coarse.h5 --oracle swinging-cube --typical --gate P=1e-2 --gate \"rate P=1.8\"\n"           \
    "  assay judge out.csv --oracle cable --param L=10 --param moving=2.5 --param U0=5 --param material.E=2e11\n"      \
    "              --param material.rho=8e3 --norm l1 --norm max\n"                                                    \
    "\n"                                                                                                               \
    "LEVELS  Each file is a level, or several: an HDF5 file may hold one in each group. They are of one time,\n"       \
    "  have the same fields, and say their spacing h, or n, spacings along a reference length; else --spacing\n"       \
    "  does.\n"                                                                                                        \
    "\n"                                                                                                               \
    "FIELDS  u displacement [m], v velocity [m/s], p momentum per unit reference volume [kg/(m^2 s)], F\n"             \
    "  deformation gradient, H its cofactor, J its determinant [-], P first Piola-Kirchhoff and sigma Cauchy\n"        \
    "  stress [Pa], pressure, the mean Cauchy stress, positive in tension [Pa], and by its name what else the\n"       \
    "  oracle knows (assay list oracles). Also known as displacement, velocity, momentum, linear_momentum,\n"          \
    "  deformation_gradient, cofactor, jacobian, first_piola_kirchhoff, pk1, cauchy, cauchy_stress, stress,\n"         \
    "  mean_stress. Points are places in the undeformed body. Tensors stand row by row; sigma may have six\n"          \
    "  numbers: xx, yy, zz, xy, yz, xz. Other fields are passed over, and named.\n"                                    \
    "\n"                                                                                                               \
    "UNITS  Those above, or these with a prefix from n to T (mm, MPa, ms, km/s); any other is refused. VTU and\n"      \
    "  VTKHDF may have none: SI units are then assumed.\n"                                                             \
    "\n"                                                                                                               \
    "HDF5    /              attributes time [s], h [m], n: of all levels that do not have their own\n"                 \
    "        /GROUP         a level, any number of them; or the level is the root itself. Attributes time, h, n\n"     \
    "          points       [N][dim], attribute unit\n"                                                                \
    "          weights      [N], optional: without them every point counts the same\n"                                 \
    "          u, P, ...    [N], [N][dim], [N][3], [N][dim*dim], [N][9] or [N][3][3], attribute unit\n"                \
    "VTKHDF  UnstructuredGrid of one time, records of assay among them. Points, PointData, FieldData with\n"           \
    "        TimeValue, h or n; datasets may have an attribute unit. A field volume, weight or weights is the\n"       \
    "        weights.\n"                                                                                               \
    "VTU     XML of an UnstructuredGrid with one Piece: ascii, binary or appended (raw or base64), zlib or\n"          \
    "        nothing. A DataArray may have an attribute unit, or its name end in [unit].\n"                            \
    "CSV     # time = 2 ms\n"                                                                                          \
    "        # h = 0.1 m\n"                                                                                            \
    "        X[m],Y[m],u_x[mm],u_y[mm],P_xx[MPa],P_yy[MPa],weight\n"                                                   \
    "        0,0.5,1.5,-3e-1,2.5,0,0.01\n"                                                                             \
    "  Components end in _x or _xx; time, h and n may be columns too.\n"                                               \
    "\n"                                                                                                               \
    "GATES  \"P=1e-2\": relative L2 error of the normal components at the finest level at most so much; P_all is\n"    \
    "  of all components, as sigma_all. With _abs absolute L2, _max relative and _abs_max absolute maximum, _l1\n"     \
    "  relative L1. \"rate P=1.8\": order from the two finest levels at least so much. Norms are those of\n"           \
    "  verify/norms.h.\n"                                                                                              \
    "\n"                                                                                                               \
    "Exit code: 0 all gates pass, or none was given, which is then said; 1 a gate or the oracle's self-check\n"        \
    "fails; 2 the command line or a file is wrong."

#define VERIFY_TRADE_HELP                                                                                              \
    "Runs a scene in many configurations and compares each with the exact solution, which first has to prove\n"        \
    "itself: error over wall time, over right-hand sides times pairs, and over bytes moved. Prints what no\n"          \
    "other configuration beats, and which to choose for an error. Writes trade.tsv, from which assay run\n"            \
    "SCENE --error takes its choice, trade.json, trade.html and the charts as trade.svg.\n"                            \
    "\n"                                                                                                               \
    "  assay trade swinging-cube\n"                                                                                    \
    "  assay trade swinging-cube --set scheme=upwind --vary cfl=0.3,0.6,0.9 --levels 8,12,16 --budget 60\n"            \
    "  assay run swinging-cube --error p=1e-3\n"                                                                       \
    "\n"                                                                                                               \
    "AXES  Every combination of scheme, stencil, support, evolved, integrator, cfl, precision and the ways that\n"     \
    "  the scene's key trade offers, at the first level, those nearest to the scene's own first. --set fixes a\n"      \
    "  key; --vary names the values to try, of these keys or of jst.*, ulsph.*, reconstruction, volume_flux,\n"        \
    "  angular_momentum, perturb and lattice. A key that changes nothing for a scheme or stencil is left out.\n"       \
    "\n"                                                                                                               \
    "LEVELS  From one to the next go, of each scheme, stencil, integrator, precision and way, those that no other\n"   \
    "  of them beats in error, pairs and bytes, and the scene's own. The others are listed as beaten.\n"               \
    "\n"                                                                                                               \
    "THREADS  One, unless the scene or --set says how many; no digit depends on it. What no other beats in time,\n"    \
    "  or by little, is timed again, and with as many threads as there are cores and the work is worth.\n"             \
    "\n"                                                                                                               \
    "BUDGET  A level may take half of the time left, the last all but a fifth, which is kept for repeats. What\n"      \
    "  was not run for want of time is listed, as is what was refused or broke down, with the reason. Errors,\n"       \
    "  pairs and bytes are the same in every study that was not cut; times are the machine's.\n"                       \
    "\n"                                                                                                               \
    "STOPPED  SIGINT (Ctrl-C), SIGTERM and SIGHUP end the study by the signal. What was measured goes to files\n"      \
    "  called trade-stopped in place of trade; --study FOLDER/trade-stopped.tsv has assay run choose from that.\n"     \
    "\n"                                                                                                               \
    "ERROR  The fronts are of one error, by default the first that assay verify shows; --error names another,\n"       \
    "  as --error u or --error \"figure period\". That of one number, as a figure is, can be small by accident,\n"     \
    "  where it changes its sign; a norm of a field cannot.\n"                                                         \
    "\n"                                                                                                               \
    "JSON    scene, oracle, error, stopped_by, overrides, budget, spent, axes {KEY: [value]}, levels [n], and\n"       \
    "        runs        [{configuration {KEY: value}, variant, n, own, particles, pairs, steps, evaluations,\n"       \
    "                    cost {pair_evaluations, bytes, seconds}, threads, repeats, noise, errors {NAME: value},\n"    \
    "                    fronts [name of cost]}]\n"                                                                    \
    "        refused, broke_down, left_out   [{configuration, variant, n, why, by}]\n"                                 \
    "        advice      [{error, run, own}]: places in runs, or null\n"                                               \
    "\n"                                                                                                               \
    "What is measured is this scene, up to its t_end: a configuration that is unstable may not show it by then."

#define VERIFY_ORACLE_HELP                                                                                             \
    "Evaluates an oracle, once it has proved itself, at the points of a file of any format that assay judge\n"         \
    "reads, or on a grid. Places outside the body are refused, or left out with --inside. Writes FILE.h5 or\n"         \
    "FILE.csv as assay judge reads them; several times or levels become groups level1, level2, ... of an HDF5\n"       \
    "file. Without --time the file's own counts. A grid's weights are those of the trapezium rule.\n"                  \
    "\n"                                                                                                               \
    "  assay oracle swinging-cube --typical --grid 0:1:11,0:1:11,0:1:11 --time 2e-3 -o exact.h5\n"                     \
    "  assay oracle cable --typical --points result.csv --time 1e-3,2e-3 -o exact.h5"

#endif
