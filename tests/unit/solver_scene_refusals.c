/* Bad, hostile and damaged scenes are refused with file, key and what was expected. */
#include "solver/scene.h"
#include "tests/unit/scene_files.h"

#include <sys/stat.h>

static const char swinging_cube[] = TEST_SOURCE_DIR "/verify/scenes/swinging-cube.lua";

static void check_refused(const char *file, const char *override, const char *expected)
{
    struct solver_scene *scene = (struct solver_scene *)&scene;
    struct solver_error error = {0};
    bool good = solver_scene_load(file, &override, override ? 1 : 0, &scene, &error);
    bool told = !good && error.code == SOLVER_BAD_INPUT && !strncmp(error.text, file, strlen(file)) &&
                strstr(error.text, expected);
    if (!told)
        printf("\nexpected: ...%s...\n     got: %s\n", expected, good ? "no error" : error.text);
    CU_ASSERT_TRUE(told);
    CU_ASSERT_PTR_NULL(scene);
    solver_scene_free(scene);
}

struct bad {
    const char *old, *new, *override, *expected;
};

static void check_all(const struct bad *bad, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        write_changed(bad[i].old, bad[i].new ? bad[i].new : "");
        check_refused(path, bad[i].override, bad[i].expected);
    }
}
#define CHECK_ALL(list) check_all(list, sizeof list / sizeof *list)

static void bad_keys(void)
{
    unit_untrapped();
    static const struct bad bad[] = {
        {"t_end", "t_edn", 0, ".lua:6: t_edn: unknown key, did you mean t_end?"},
        {"nu =", "mu =", 0, ".lua: material.mu: unknown key, did you mean material.nu?"},
        {"t_end = 1", "", 0, ".lua: t_end: missing; expected number > 0 [s]"},
        {"rho = 2", "", 0, ".lua: material.rho: missing; expected number > 0 [kg/m^3]"},
        {"title = 'plain'", "", 0, ".lua: title: missing; expected text"},
        {"n = 4", "", 0, ".lua: n: missing; expected whole number >= 1"},
        {0, "n = 5", 0, ".lua:8: n: assigned twice"},
        {"title = 'plain'", "title = 3", 0, "title: expected text, got 3"},
        {"title = 'plain'", "title = ''", 0, "title: expected text of 1 to 511 bytes, got 0"},
        {"'plain'", "'a\\nb'", 0, "title: expected text on one line, got a control character (code 10)"},
        {"E = 10", "E = 'stiff'", 0, ".lua: material.E: expected number > 0 [Pa], got the text 'stiff'"},
        {"E = 10", "E = '10'", 0, "material.E: expected number > 0 [Pa], got the text '10'"},
        {"E = 10", "E = {}", 0, "material.E: expected number > 0 [Pa], got a table"},
        {"E = 10", "E = 0/0", 0, ".lua: material.E: expected number > 0 [Pa], got NaN"},
        {"E = 10", "E = math.huge", 0, "material.E: expected number > 0 [Pa], got an infinite number"},
        {"E = 10", "E = -10", 0, "material.E: expected number > 0 [Pa], got -10"},
        {"rho = 2", "rho = 0", 0, "material.rho: expected number > 0 [kg/m^3], got 0"},
        {"nu = 0.3", "nu = 0.7", 0, ".lua: material.nu: expected number in (-1, 0.5], got 0.7"},
        {"E = 10", "E = 1e300", 0, "material.E: products of moduli, densities and lengths would leave the range of"},
        {"E = 10", "E = 1e-51", 0, "expected number in [1e-50, 1e+50] [Pa], got 1e-51"},
        {"rho = 2", "rho = 1e51", 0,
         "material.rho: products of moduli, densities and lengths would leave the range of"},
        {0, "reference_length = 1e25", 0, "reference_length: products of moduli, densities and lengths would leave"},
        {"nu = 0.3", "nu = -1", 0, "material.nu: expected number in (-1, 0.5], got -1"},
        {"'neo-hookean'", "'rubber'", 0,
         "material.model: expected one of linear-elastic, neo-hookean, neo-hookean-polyconvex, hencky, got the text"},
        {"material =", "material = 4 local m =", 0, "material: expected a table, got 4"},
        {"t_end = 1", "t_end = nil", 0, ".lua:6: t_end: expected a value, got nothing"},
        {"dim = 2", "dim = 4", 0, "dim: expected 1, 2 or 3, got 4"},
        {"dim = 2", "dim = 1.5", 0, "dim: expected 1, 2 or 3, got 1.5"},
        {"dim = 2", "dim = 3", 0, "domain.lower: expected a list of 3 numbers, got 2 entries"},
        {"{0, 0}", "{0, 0/0}", 0, "domain.lower[2]: expected a number, got NaN"},
        {"{0, 0}", "{3, 0}", 0, "domain.upper[1]: expected a number above domain.lower[1] = 3, got 2"},
        {0, "scheme = 'efg'", 0, "scheme: 'efg' is not there yet; expected one of upwind, jst, ulsph"},
        {0, "scheme = 'jst' jst = { kappa4 = -1 }", 0, "jst.kappa4: expected number in [0, 10], got -1"},
        {0, "jst = { kappa3 = 1 }", 0, "jst.kappa3: unknown key, did you mean jst.kappa2?"},
        {0, "jst = { dissipation = 1 }", 0,
         "jst.dissipation: unknown key; there are jst.kappa2, jst.kappa4, jst.kappa4_plastic, jst.plastic_at"},
        {0, "integrator = 'rk5'", 0, "integrator: expected one of euler, tvd-rk2, ssp-rk3, rk4, got the text 'rk5'"},
        {0, "precision = 'half'", 0, "precision: expected one of double, mixed, single, got the text 'half'"},
        {0, "precision = 'single' scheme = 'jst'", 0, "precision: single is for scheme = \"upwind\", not jst"},
        {0, "precision = 'single' scheme = 'ulsph'", 0, "precision: single is for scheme = \"upwind\", not ulsph"},
        {0, "precision = 'single' stencil = 'sph'", 0, "precision: single is for antisymmetric stencils"},
        {0, "precision = 'single' evolved = 'pFJ' volume_flux = 'stress'", 0, "precision: single knows volume_flux"},
        {0, "precision = 'single' balance = true", 0, "precision: single measures no dissipation (balance)"},
        {0, "precision = 'single' angular_momentum = 'projected'", 0, "precision: single keeps no momentum"},
        {"'neo-hookean'", "'hencky', yield_stress = 1, hardening = 0", "precision=single",
         "precision: single knows no plastic flow (material.yield_stress)"},
        {0, "precision = 'single' rigid_wall = { point = {0, 0}, normal = {1, 0} }", 0,
         "precision: single knows no walls (rigid_wall, die)"},
        {0, "precision = 'mixed' scheme = 'jst'", 0, "precision: mixed is for scheme = \"upwind\", not jst"},
        {0, "precision = 'mixed' scheme = 'ulsph'", 0, "precision: mixed is for scheme = \"upwind\", not ulsph"},
        {0, "precision = 'mixed' stencil = 'sph'", 0, "precision: mixed is for antisymmetric stencils"},
        {0, "precision = 'mixed' evolved = 'pFJ' volume_flux = 'stress'", 0, "precision: mixed knows volume_flux"},
        {0, "scheme = '|'", 0, "scheme: expected one of upwind, jst, ulsph, got the text '|'"},
        {0, "evolved = 'pFH'", 0, "evolved: expected one of pF, pFJ, pFHJ, got the text 'pFH'"},
        {0, "cfl = 0", 0, "cfl: expected number in (0, 10], got 0"},
        {0, "cfl = 10.1", 0, "cfl: expected number in (0, 10], got 10.1"},
        {0, "support = 0.9", 0, "support: expected number in [1, 4], got 0.9"},
        {0, "perturb = 0.46", 0, "perturb: expected number in [0, 0.45], got 0.46"},
        {0, "threads = -1", 0, "threads: expected whole number in [0, 1024], got -1"},
        {0, "seed = -1", 0, "seed: expected whole number >= 0, got -1"},
        {0, "body_force = 9.81", 0, "body_force: expected function(X, Y, Z, t) returning dim numbers, got 9.81"},
        {0, "x = 1", 0, ".lua:8: x: unknown key"},
    };
    CHECK_ALL(bad);
}

static void bad_pressures(void)
{
    unit_untrapped();
    static const struct bad bad[] = {
        {"nu = 0.3", "nu = 0.5", 0,
         "material.nu: 0.5 is incompressible, and the pressure is then an unknown of its own; take "
         "incompressible.solver = \"poisson\""},
        {0, "incompressible = { solver = 'cg' }", 0,
         "incompressible.solver: expected one of none, poisson, pseudo-time, got the text 'cg'"},
        {0, "incompressible = { solver = 'poisson' }", 0, "expected material.nu in [0.4, 0.5], got 0.3"},
        {"rho = 2 }", "rho = 2, nu = 0.45 } incompressible = { solver = 'poisson', alpha = 0.5 }", 0,
         "incompressible.alpha: belongs to incompressible.solver = \"pseudo-time\""},
        {0, "incompressible = { alpha = 1.5 }", 0, "incompressible.alpha: expected number in [0, 1], got 1.5"},
        {0, "incompressible = { tolerance = 0 }", 0,
         "incompressible.tolerance: expected number in [1e-14, 0.01], got 0"},
        {0, "incompressible = { iterations = 0 }", 0,
         "incompressible.iterations: expected whole number in [1, 1000000]"},
        {0, "incompressible = { beta = 1 }", 0, "incompressible.beta: unknown key"},
    };
    CHECK_ALL(bad);
}

static void bad_gradings(void)
{
    unit_untrapped();
    static const struct bad bad[] = {
        {0, "grading = { X = 0.5 }", 0, "grading.X: expected number in [1, 1e6], got 0.5"},
        {0, "grading = { X = 0/0 }", 0, "grading.X: expected number in [1, 1e6], got NaN"},
        {0, "grading = { X = 1e7 }", 0, "grading.X: expected number in [1, 1e6], got 10000000"},
        {0, "grading = { X = 2, fine_X = 'left' }", 0,
         "grading.fine_X: expected one of lower, upper, both, middle, got the text 'left'"},
        {0, "grading = { ratio = 2 }", 0, "grading.ratio: unknown key"},
        {0, "grading = { Z = 2 }", 0, "grading.Z: a body of dim = 2 has no such axis"},
        {0, "grading = { Y = 2 } stencil = 'closed'", 0,
         "grading.Y: stencil = \"closed\" has one support for all particles; expected sbp2 or sbp4"},
        {0, "grading = { Y = 2 } scheme = 'ulsph'", 0,
         "grading.Y: the kernel of scheme = \"ulsph\" has one support for all particles; expected upwind or jst"},
        {0, "grading = { Y = 2 } lattice = 'centres'", 0, "grading.Y: expected lattice = \"nodes\" with it"},
        {0, "grading = { Y = 2 } perturb = 0.1", 0, "grading.Y: expected perturb = 0 with it, got 0.1"},
    };
    CHECK_ALL(bad);
}

static void bad_resolution(void)
{
    unit_untrapped();
    static const struct bad bad[] = {
        {"n = 4", "n = 0", 0, "n: expected whole number >= 1, got 0"},
        {"n = 4", "n = 4.5", 0, "n: expected whole number >= 1, got 4.5"},
        {"n = 4", "n = 1000000000", 0,
         "n = 1000000000: asks for 5e+17 particles and about 7.5e+08 TB of memory; this machine has"},
        {"n = 4", "n = 1e300", 0, "particles and about inf TB of memory; this machine has"},
        {"n = 4", "n = 3", 0, "n = 3: the edge along Y, 1 m, is 1.5 spacings of 0.666667 m; expected a whole number"},
        {0, "levels = {4, 5}", 0, "levels[2] = 5: the edge along Y, 1 m, is 2.5 spacings of 0.4 m"},
        {0, "levels = {8, 4}", 0, "levels[2]: expected increasing values of n, got 4 after 8"},
        {0, "levels = {}", 0, "levels: expected list of 1 to 16 increasing whole numbers >= 1, got a table"},
        {0, "levels = 4", 0, "levels: expected list of 1 to 16 increasing whole numbers >= 1, got 4"},
        {0, "levels = {4, 'x'}", 0, "levels[2]: expected a number, got the text 'x'"},
        {0, "levels = {4, 2e9}", 0, "levels[2] = 2000000000: asks for 2e+18 particles"},
        {0, "reference_length = 1e-9", 0, "of memory; this machine has"},
        {0, "reference_length = 1e9", 0, "n = 4: the edge along X, 2 m, is 8e-09 spacings"},
    };
    CHECK_ALL(bad);
}

static void bad_parts(void)
{
    unit_untrapped();
    static const struct bad bad[] = {
        {0, "faces = { Z0 = 'free' }", 0, "faces.Z0: a body of dim = 2 has no such face"},
        {0, "faces = { W0 = 'free' }", 0, "faces.W0: unknown key, did you mean faces."},
        {0, "faces = { X0 = 'glued' }", 0, "faces.X0: expected free, symmetric, skew-symmetric, clamped"},
        {0, "faces = { X0 = 'traction' }", 0, "faces.X0: 'traction' needs value = function(X, Y, Z, t) returning 2"},
        {0, "faces = { X0 = { kind = 'motion', value = 3 } }", 0, "faces.X0: 'motion' needs value = function"},
        {0, "faces = { X0 = { kind = 'free', value = function() end } }", 0, "faces.X0: 'free' takes no value"},
        {"initial = { velocity", "initial = { from = 'oracle', velocity", 0,
         "initial.from: the oracle gives the initial state, and the scene a formula"},
        {0, "faces = { X0 = { kind = 'free', speed = 1 } }", 0,
         "faces.X0.speed: unknown key; expected kind, value, traction, free_after and within"},
        {0, "faces = { X0 = 'roller' }", 0,
         "faces.X0: 'roller' needs value = function(X, Y, Z, t) returning 2 numbers"},
        {0,
         "faces = { X0 = { kind = 'motion', value = function() return 0, 0, 0 end, traction = function() return 0, 0, "
         "0 end } }",
         0, "faces.X0: 'motion' takes no traction"},
        {0, "faces = { X0 = { kind = 'roller', value = function() return 0, 0, 0 end, traction = 1 } }", 0,
         "faces.X0: 'roller' needs traction = function(X, Y, Z, t) returning 2 numbers"},
        {0, "loads = { from = 'oracle' } faces = { X0 = { kind = 'motion', value = function() return 0, 0, 0 end } }",
         0, "faces.X0: loads.from: the oracle gives what the face prescribes, and the scene a value besides"},
        {0, "loads = { from = 'oracle' } faces = { X0 = { kind = 'motion', free_after = 1 } }", 0,
         "faces.X0.free_after: loads.from: the oracle drives the face for good"},
        {0, "loads = { from = 'oracle' } body_force = function() return 0, 0, 0 end", 0,
         "loads.from: the oracle gives the body force, and the scene a formula for it besides"},
        {0, "faces = { X0 = { kind = 'clamped', free_after = 1 } }", 0,
         "faces.X0: only 'motion' and 'roller' take free_after, 'clamped' lasts"},
        {0, "faces = { X0 = { kind = 'motion', value = function() return 0, 0, 0 end, free_after = -1 } }", 0,
         "faces.X0.free_after: expected number > 0 [s]"},
        {0, "faces = { X0 = { kind = 'clamped', within = { {0, 0}, {0, 1} } } }", 0,
         "faces.X0.within: only 'motion' and 'roller' without traction take it"},
        {0, "faces = { X0 = { kind = 'motion', value = function() return 0, 0 end, within = { {0, 0} } } }", 0,
         "faces.X0.within: expected a list of two corners"},
        {0, "faces = { X0 = { kind = 'motion', value = function() return 0, 0 end, within = { {0, 1}, {0, 0} } } }", 0,
         "faces.X0.within: expected a lower and an upper corner, got 1 and 0 along Y"},
        {0,
         "lattice = 'centres' faces = { X0 = { kind = 'motion', value = function() return 0, 0 end, within = { {0, 0}, "
         "{0, 1} } } }",
         0, "faces.X0.within: with lattice = \"centres\" a wall moves the face, all of it"},
        {0, "faces = { X1 = { kind = 'traction', value = function(X) return X end } }", 0,
         "faces.X1.value at X = (2, 0, 0), t = 0: expected 2 numbers, got 1"},
        {0, "probes = { { name = 'a', X = {3, 0} } }", 0, "probes[1].X[1]: 3 lies outside the domain, 0 to 2"},
        {0, "probes = { { name = 'a' } }", 0, "probes[1].X: expected a list of 2 numbers, got nothing"},
        {0, "probes = { { X = {0, 0} } }", 0, "probes[1].name: expected text, got nothing"},
        {0, "probes = { {name='a',X={0,0}}, {name='a',X={1,0}} }", 0, "probes[2].name: the name 'a' is taken"},
        {0, "snapshots = 1", 0, "snapshots: expected list of increasing numbers in (0, t_end] [s], got 1"},
        {0, "snapshots = {0}", 0, "snapshots[1]: expected number > 0 [s], got 0"},
        {0, "snapshots = {0.5, 0/0}", 0, "snapshots[2]: expected number > 0 [s], got NaN"},
        {0, "snapshots = {0.5, 0.5}", 0, "snapshots[2]: expected increasing times, got 0.5 s after 0.5 s"},
        {0, "snapshots = {0.5, 1}", "t_end=0.9", "snapshots[2]: 1 s lies after t_end = 0.9 s; take a later t_end or"},
    };
    CHECK_ALL(bad);
}

static void bad_lists(void)
{
    unit_untrapped();
    static const struct bad bad[] = {
        {0, "snapshots = {1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17}", 0, "snapshots: at most 16 entries"},
        {0, "snapshots = { at = 0.5 }", 0, "snapshots: expected a list without gaps and without names"},
        {0, "trade = 3", 0, "trade: expected { [NAME] = { KEY = value, ... }, ... }, got 3"},
        {0, "trade = { { cfl = 1 } }", 0, "trade: expected names as keys, got 1"},
        {0, "trade = { a = 1 }", 0, "trade.a: expected { KEY = value, ... }, got 1"},
        {0, "trade = { a = {} }", 0, "trade.a: expected at least one KEY = value"},
        {0, "trade = { ['a\\nb'] = { cfl = 1 } }", 0, "trade: expected names of 1 to 63 bytes without control"},
        {0, "trade = { [''] = { cfl = 1 } }", 0, "trade: expected names of 1 to 63 bytes without control"},
        {0, "trade = { a = { n = 8 } }", 0, "trade.a.n: the study varies it, or it is another problem"},
        {0, "trade = { a = { dim = 3 } }", 0, "trade.a.dim: the study varies it, or it is another problem"},
        {0, "trade = { a = { clf = 1 } }", 0, "trade.a.clf: 'clf' is no plain key and no parameter of this scene"},
        {0, "trade = { a = { cfl = 11 } }", 0, "trade.a.cfl: expected number in (0, 10], got 11"},
        {0, "local t = {} for i = 1, 9 do t['v' .. i] = { cfl = 1 } end trade = t", 0, "trade: at most 8 entries"},
        {0, "figures = 3", 0, "figures: expected { [NAME] = { measure = text, OPTION = ..., ... }, ... }, got 3"},
        {0, "figures = { 'a' }", 0, "figures: expected names as keys, got 1"},
        {0, "figures = { a = 'b' }", 0, "figures.a: expected { measure = text, OPTION = ..., ... }, got the text 'b'"},
        {0, "figures = { a = { x = 1 } }", 0, "figures.a.measure: missing; expected text, see assay list measures"},
        {0, "figures = { a = { measure = 1 } }", 0, "figures.a.measure: expected text, got 1"},
        {0, "figures = { a = { measure = 'm', of = {1, 2, 3, 4, 5} } }", 0, "figures.a.of: at most 4 entries are"},
        {0, "figures = { a = { measure = 'm', of = {1, 'x'} } }", 0,
         "figures.a.of[2]: expected a number, got the text"},
        {0, "figures = { a = { measure = 'm', of = true } }", 0, "figures.a.of: expected text, a number or a list of"},
        {0, "figures = { a = { measure = 'm', 7 } }", 0, "figures.a: expected names as keys, got 1"},
        {0, "figures = { a234567890123456789012345678901234567890123456789012345678901234 = { measure = 'm' } }", 0,
         "figures: expected text of 1 to 63 bytes, got 64"},
        {0, "figures = { a = { measure = 'm', a=1, b=1, c=1, d=1, e=1, f=1, g=1, h=1, i=1 } }", 0,
         "figures.a: at most 8 options are possible"},
        {0, "local f = {} for i = 1, 17 do f['f' .. i] = { measure = 'm' } end figures = f", 0,
         "figures: at most 16 are possible"},
        {0, "history = 0", 0, "history: expected whole number in [1, 100000], got 0"},
        {0, "history = 100001", 0, "history: expected whole number in [1, 100000], got 100001"},
        {0, "probe_scale = 0", 0, "probe_scale: expected number > 0 [m], got 0"},
        {0, "probes = { a = {0, 0} }", 0, "probes: expected a list without gaps and without names, got the text 'a'"},
        {0, "oracle = 'cube'", 0, "oracle: expected { name = text }, got the text 'cube'"},
        {0, "oracle = { nu = 0.3 }", 0, "oracle.name: expected text, got nothing"},
        {0, "oracle = { name = 'c', nu = 'x' }", 0, "oracle.material.nu: expected a number, got the text 'x'"},
        {0, "oracle = { name = 'c', nu = 1, material = { nu = 1 } }", 0, "oracle.material.nu: told twice"},
        {0, "published = { { n = 4, p = 1 } }", 0, "published.source: expected text, got nothing"},
        {0, "published = { source = 's', { p = 1 } }", 0, "published[1].n: expected whole number >= 1, got nothing"},
        {0, "published = { source = 's', { n = 4, p = 0/0 } }", 0, "published[1].p: expected a number, got NaN"},
        {0, "gates = { { when = { cfl = 0.8 } } }", 0, "gates[1]: expected at least one NAME = bound"},
        {0, "gates = { { p = 'low' } }", 0, "gates[1].p: expected a number, got the text 'low'"},
        {0, "gates = { { p = 1, when = { stencli = 'sph' } } }", 0,
         "gates[1].when.stencli: 'stencli' is no plain key and no parameter of this scene, did you mean stencil?"},
        {0, "gates = { { p = 1, when = { stencil = 'spb4' } } }", 0,
         "gates[1].when.stencil: expected one of sph, closed, sbp2, sbp4, got the text 'spb4'"},
        {0, "gates = { { p = 1, when = { cfl = '0.8' } } }", 0, "gates[1].when.cfl: expected number in (0, 10], got"},
        {0, "gates = { { p = 1, when = { stencil = 4 } } }", 0, "gates[1].when.stencil: expected one of sph"},
        {0, "view = { field = 'p', range = {0, 0} }", 0, "view.range: expected two increasing numbers, got 0 and 0"},
        {0, "view = { field = 'p', range = {1, 1} }", 0, "view.range: expected two increasing numbers, got 1 and 1"},
        {0, "view = { field = 'p', range = {0, 1}, up = {0, 0, -2} }", 0, "view.up: expected a direction that"},
        {0, "view = { field = 'p', range = {0, 1}, frame = {0, 1, 2, 1, 0, 0} }", 0,
         "view.frame: expected x0 <= x1, y0 <= y1, z0 <= z1, got 2 and 1 along Y"},
        {0, "view = { field = 'p', range = {0, 1}, frame = {1, 1, 0, 0, 0, 0} }", 0, "view.frame: expected a box"},
        {0, "view = { field = 'p', range = {0, 1}, size = {10, 100} }", 0, "view.size: expected list of 2 whole"},
        {0, "parameters = { A = 'x' }", 0, "parameters.A: expected a number, got the text 'x'"},
        {0, "parameters = { A = 0/0 }", 0, "parameters.A: expected a number, got NaN"},
        {0, "parameters = { cfl = 1 }", 0, "parameters.cfl: the name 'cfl' is taken; choose another"},
        {0, "parameters = { math = 1 }", 0, "parameters.math: the name 'math' is taken; choose another"},
        {0, "parameters = { ['a b'] = 1 }", 0, "parameters: expected a name of letters, digits and _"},
    };
    CHECK_ALL(bad);
}

static void bad_overrides(void)
{
    unit_untrapped();
    static const struct bad bad[] = {
        {0, 0, "nn=3", ".lua: --set nn=3: unknown key, did you mean n?"},
        {0, 0, "material.mu=3", ".lua: --set material.mu=3: unknown key, did you mean material.nu?"},
        {0, 0, "nu=0.2", ".lua: --set nu=0.2: unknown key, did you mean material.nu?"},
        {0, 0, "incompressible.tol=1", ": unknown key, did you mean incompressible.tolerance?"},
        {0, 0, "material.youngs=1", ": unknown key; there are material.model, material.E, "},
        {0, 0, "A=3", "--set A=3: unknown key"},
        {0, "parameters = { A = 1 }", "parameters.B=3", "--set parameters.B=3: unknown key"},
        {0, "parameters = { A = 1 }", "A=x", "parameters.A: expected a number, got the text 'x'"},
        {0, 0, "n", "--set n: expected KEY=VALUE on one line"},
        {0, 0, "n=", "--set n=: expected KEY=VALUE on one line"},
        {0, 0, "=4", "--set =4: expected KEY=VALUE on one line"},
        {0, 0, "n=nan", "n: expected whole number >= 1, got the text 'nan' (from --set)"},
        {0, 0, "cfl=inf", "cfl: expected number in (0, 10], got the text 'inf' (from --set)"},
        {0, 0, "cfl=1e999", "cfl: expected number in (0, 10], got an infinite number"},
        {0, 0, "material.nu=0.7", "material.nu: expected number in (-1, 0.5], got 0.7 (from --set)"},
        {0, 0, "material=3", "material: expected a table, got 3 (from --set)"},
        {0, 0, "n.x=3", "--set n.x=3: unknown key"},
        {0, 0, "levels={4,8", "--set levels={4,8: expected a list {a,b,c}"},
        {0, 0, "levels={4,,8}", "--set levels: expected a list {a,b,c}, entry 2 is empty or too long"},
        {0, 0, "initial.velocity=3", "initial.velocity: expected function(X, Y, Z, t) returning dim numbers, got 3"},
        {0, "faces = { X0 = 'free' }", "faces.X0.kind=clamped", "--set faces.X0.kind: 'faces.X0' is no table here"},
    };
    CHECK_ALL(bad);
}

static void hostile_scenes(void)
{
    static const struct bad bad[] = {
        {0, "while true do end", 0, ".lua:8: did not end within its budget of 10000000 instructions: an endless loop?"},
        {"return X, Y", "while true do end", 0,
         ".lua:7: initial.velocity at X = (0, 0, 0), t = 0: did not end within its budget of 1000000"},
        {0, "local function f() return 1 + f() end f()", 0, "instructions: an endless loop?"},
        {0,
         "local f = function() end for i = 1, 1e5 do local g = f f = function() return g() end end "
         "body_force = function() f() return 0, 0 end",
         0, "nested more than 50 deep"},
        {0, "local s = 'x' while true do s = s .. s end", 0, ".lua: asks for a string of more than 16 KiB"},
        {0, "local t = {} for i = 1, 2e6 do t[i] = i end", 0, "did not end within its budget of 10000000 instructions"},
        {0, "local s, t = 'xxxxxxxx', {} for i = 1, 10 do s = s .. s end for i = 1, 1e5 do t[i] = s .. i end", 0,
         ".lua: asks for more than 64 MiB of memory"},
        {0, "local t = {} t.t = t view = t", 0, "view: tables are nested more than 8 deep"},
        {0, "local t = {} t[{}] = 1 view = t", 0, "view: expected a table whose keys are names or 1, 2, 3"},
        {0, "local x = ('x'):rep(9)", 0, ".lua:8: attempt to index a string value"},
        {0, "local x = io", 0, ".lua:8: io: undefined name"},
        {0, "os.exit(0)", 0, ".lua:8: os: undefined name"},
        {0, "require('x')", 0, "require: undefined name"},
        {0, "load('x')", 0, "load: undefined name"},
        {0, "dofile('x')", 0, "dofile: undefined name"},
        {0, "pcall(error)", 0, "pcall: undefined name"},
        {0, "setmetatable({}, {})", 0, "setmetatable: undefined name"},
        {0, "rawset(_G, 'x', 1)", 0, "rawset: undefined name"},
        {0, "collectgarbage()", 0, "collectgarbage: undefined name"},
        {0, "coroutine.wrap(print)()", 0, "coroutine: undefined name"},
        {0, "local x = debug", 0, "debug: undefined name"},
        {0, "local x = string", 0, "string: undefined name"},
        {0, "seed = math.random()", 0, "attempt to call a nil value (field 'random')"},
        {0, "math.pi = 3", 0, ".lua:8: tables of a scene cannot be changed once they are assigned"},
        {0, "material.E = 11", 0, ".lua:8: tables of a scene cannot be changed once they are assigned"},
        {0, "_ENV = {} cfl = 3", 0, "_ENV: assigned; keys after that would be lost"},
        {0, "seed = cfl", 0, ".lua:8: cfl: read before it is assigned"},
        {0, "cfl = Materal", 0, ".lua:8: Materal: undefined name, did you mean material?"},
        {0, "error({})", 0, ".lua: error without a message"},
        {0, "error('no')", 0, ".lua:8: no"},
        {0, "error('no', 0)", 0, ".lua: no"},
        {0, "x = = 3", 0, ".lua:8: unexpected symbol near '='"},
        {0, "if true then", 0, ".lua:9: 'end' expected (to close 'if' at line 8) near <eof>"},
        {0, "\x1bLua", 0, "unexpected symbol near '<\\27>'"},
    };
    CHECK_ALL(bad);
    char deep[5000];
    memset(deep, '(', sizeof deep - 1);
    deep[sizeof deep - 1] = '\0';
    write_changed(NULL, deep);
    check_refused(path, NULL, "C stack overflow");
}

static void bad_formulas(void)
{
    unit_untrapped();
    static const struct bad bad[] = {
        {"return X, Y", "return X", 0, "initial.velocity at X = (0, 0, 0), t = 0: expected 2 numbers, got 1"},
        {"return X, Y", "return X, Y, Z", 0, "expected 2 numbers, got 3"},
        {"return X, Y", "", 0, "expected 2 numbers, got 0"},
        {"return X, Y", "return X, '1'", 0, "t = 0: value 2: expected a number, got the text '1'"},
        {"return X, Y", "return 0/0, X", 0, "t = 0: value 1: expected a number, got NaN"},
        {"return X, Y", "return X, 1/X", 0, "t = 0: value 2: expected a number, got an infinite number"},
        {"return X, Y", "return X + nil, Y", 0, ".lua:7: initial.velocity at X = (0, 0, 0), t = 0: attempt to perform"},
        {"return X, Y", "return V * X, Y", 0, ".lua:7: initial.velocity at X = (0, 0, 0), t = 0: V: undefined name"},
        {"return X, Y", "cfl = 1 return X, Y", 0, "assigns the global 'cfl'; a formula must depend on X, Y, Z and t"},
        {"return X, Y", "material.E = 1 return X, Y", 0, "tables of a scene cannot be changed"},
        {0, "local k = 0 body_force = function() k = k + 1 return k, k end", 0,
         "body_force at X = (0, 0, 0), t = 0: changes 'k', which outlives the call"},
        {0, "local k body_force = function() k = 1 return k, k end", 0, "changes 'k', which outlives the call"},
        {0, "local k = 1 local function f() k = nil return 1, 1 end body_force = function() return f() end", 0,
         "changes 'k', which outlives the call"},
        {0, "local t = {0} body_force = function() t[1] = t[1] + 1 return 0, 0 end", 0,
         "tables of a scene cannot be changed"},
        {0, "initial_F = 1", 0, "initial_F: unknown key, did you mean initial.F?"},
    };
    CHECK_ALL(bad);
}

static void unreadable_files(void)
{
    char missing[SCRATCH_BELOW], pipe_path[SCRATCH_BELOW];
    snprintf(missing, sizeof missing, "%s/none.lua", folder);
    snprintf(pipe_path, sizeof pipe_path, "%s/pipe.lua", folder);
    check_refused(missing, NULL, "cannot be opened: No such file or directory");
    check_refused(folder, NULL, "is a directory; expected a scene file (.lua)");
    CU_ASSERT_EQUAL_FATAL(mkfifo(pipe_path, 0600), 0);
    check_refused(pipe_path, NULL, "is no regular file; expected a scene file (.lua)");
    unlink(pipe_path);
    if (geteuid() != 0) { /* root may read everything */
        write_scene(plain, strlen(plain));
        chmod(path, 0);
        check_refused(path, NULL, "cannot be opened: Permission denied");
        chmod(path, 0600);
    }
    write_scene("\033LuaT\0\x19\x93", 8);
    check_refused(path, NULL, "is binary; expected a scene written as text");
    write_scene("title = 'a'\0", 12);
    check_refused(path, NULL, "is binary; expected a scene written as text");
    write_scene("", 0);
    check_refused(path, NULL, "title: missing; expected text (what the scene shows)");
    static char long_path[5000];
    memset(long_path, 'a', sizeof long_path - 1);
    struct solver_scene *scene;
    struct solver_error error;
    CU_ASSERT_FALSE(solver_scene_load(long_path, NULL, 0, &scene, &error));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "the path has 4999 bytes; at most 4095 are possible"));
    CU_ASSERT_PTR_NULL(scene);
    static char large[(1 << 20) + 1];
    memset(large, ' ', sizeof large);
    write_scene(large, sizeof large);
    check_refused(path, NULL, "has 1048577 bytes; a scene has at most 1048576");
}

/* Cut short anywhere, or with any one byte changed, the good scene is read or refused, with the file named. */
static void mangled_scenes(void)
{
    static char text[1 << 14], mangled[1 << 14];
    FILE *file = fopen(swinging_cube, "rb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    size_t size = fread(text, 1, sizeof text, file), refused = 0;
    CU_ASSERT_FATAL(size > 1000 && size < sizeof text);
    CU_ASSERT_EQUAL(fclose(file), 0);
    for (size_t i = 0; i < 2 * size; i++) {
        struct solver_scene *scene;
        struct solver_error error = {0};
        memcpy(mangled, text, size);
        if (i >= size)
            mangled[i - size] = (char)(mangled[i - size] ^ (1 << (i % 7)));
        write_scene(mangled, i < size ? i : size);
        bool good = solver_scene_load(path, NULL, 0, &scene, &error);
        refused += !good;
        if (good != (scene != NULL) || (!good && strncmp(error.text, path, strlen(path)) != 0))
            CU_FAIL("a mangled scene was neither read nor refused with its file named");
        solver_scene_free(scene);
    }
    CU_ASSERT(refused > size / 2 && refused < 2 * size);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"bad keys", bad_keys},
        {"bad pressures", bad_pressures},
        {"bad gradings", bad_gradings},
        {"bad resolution", bad_resolution},
        {"bad parts", bad_parts},
        {"bad lists", bad_lists},
        {"bad overrides", bad_overrides},
        {"bad formulas", bad_formulas},
        {"hostile scenes", hostile_scenes},
        {"unreadable files", unreadable_files},
        {"mangled scenes", mangled_scenes},
    };
    return scene_files_main("scene refusals", tests, sizeof tests / sizeof *tests);
}
