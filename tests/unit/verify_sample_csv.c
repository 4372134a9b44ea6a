/* Tables: what they hold, and what is wrong with them by line. */
#include "tests/unit/sample_files.h"
#include "verify/units.h"

static void takes_all_there_is(void)
{
    const struct verify_sample *sample = sample_of_text("# made by hand\n"
                                                        "# time = 2 ms\n"
                                                        "# h = 0.25 m\n"
                                                        "X[m], Y [m],u_x[mm],u_y[mm],P_xx[MPa],P_yy[MPa],weight,s[-]\n"
                                                        "0,0,1,2,3,4,0.5,7\n"
                                                        "\n"
                                                        "# a comment between\n"
                                                        " 1 ,1e-1,-1,2.5,3,4,0.25,8\r\n");
    CU_ASSERT_EQUAL(sample->count, 2);
    CU_ASSERT_EQUAL(sample->dim, 2);
    CU_ASSERT_TRUE(sample->needs_units && sample->has_unit && !sample->single);
    CU_ASSERT_STRING_EQUAL(sample->unit, "m");
    CU_ASSERT_EQUAL(sample->time.value, 2);
    CU_ASSERT_STRING_EQUAL(sample->time.unit, "ms");
    CU_ASSERT_EQUAL(sample->h.value, 0.25);
    CU_ASSERT_TRUE(sample->X[3] == 1 && sample->X[4] == 0.1 && sample->X[5] == 0);
    CU_ASSERT_TRUE(sample->weight[0] == 0.5 && sample->weight[1] == 0.25);
    const struct verify_sample_field *u = sample_field(sample, "u"), *P = sample_field(sample, "P");
    CU_ASSERT_TRUE(u->width == 3 && u->given == 3 && u->has_unit);
    CU_ASSERT_STRING_EQUAL(u->unit, "mm");
    CU_ASSERT_TRUE(u->value[3] == -1 && u->value[4] == 2.5);
    CU_ASSERT_TRUE(P->width == 9 && P->given == (1U | 1U << 4));
    CU_ASSERT_TRUE(P->value[9] == 3 && P->value[13] == 4);
    CU_ASSERT_TRUE(sample_field(sample, "s")->width == 1 && sample_field(sample, "s")->value[1] == 8);
}

static void takes_numbers_from_columns(void)
{
    const struct verify_sample *sample = sample_of_text("\"X[m]\",\"t[s]\",\"n\",\"v_x[m/s]\"\n0,3,16,1\n1,3,16,2\n");
    CU_ASSERT_EQUAL(sample->time.value, 3);
    CU_ASSERT_STRING_EQUAL(sample->time.unit, "s");
    CU_ASSERT_EQUAL(sample->n, 16);
    CU_ASSERT_TRUE(isnan(sample->h.value));
    CU_ASSERT_EQUAL(sample->dim, 1);
    CU_ASSERT_EQUAL(sample_field(sample, "v")->given, 1);
}

static void without_a_last_line_end(void)
{
    const struct verify_sample *sample = sample_of_text("\xef\xbb\xbfX[m],Y[m],Z[m]\n0,1,2\n3,4,5");
    CU_ASSERT_EQUAL(sample->count, 2);
    CU_ASSERT_EQUAL(sample->dim, 3);
    CU_ASSERT_EQUAL(sample->X[5], 5);
}

static void refuses(void)
{
    unit_untrapped();
    static const struct {
        const char *text, *words;
    } wrong[] = {
        {"", "neither HDF5 nor XML"},
        {"hello\n", "neither HDF5 nor XML"},
        {"a[m],b[m]\n1,2\n", "line 1: no column X"},
        {"X,u_x[m]\n1,2\n", "line 1: column X has no unit"},
        {"X[m],Z[m]\n1,2\n", "in the order X, Y, Z"},
        {"Y[m],X[m]\n1,2\n", "in the order X, Y, Z"},
        {"X[m],Y[mm]\n1,2\n", "have one unit"},
        {"X[m],u_x[m]\n1\n", "line 2: 1 values, expected 2"},
        {"X[m],u_x[m]\n1,2\n1,2,3\n", "line 3: more than the 2 values"},
        {"X[m],u_x[m]\n1,two\n", "line 2: column u_x: \"two\", expected a finite number"},
        {"X[m],u_x[m]\n1,2 3\n", "line 2: column u_x"},
        {"X[m],u_x[m]\n1,nan\n", "expected a finite number"},
        {"X[m],u_x[m]\n1,-inf\n", "expected a finite number"},
        {"X[m],u_x[m]\n1,1e999\n", "expected a finite number"},
        {"X[m],u_x[m]\n1,\n", "expected a finite number"},
        {"X[m],u_x[m],u_x[m]\n1,2,3\n", "given twice"},
        {"X[m],u_x[m],u_xx[m]\n1,2,3\n", "scalar, vector and tensor at once"},
        {"X[m],u_x[m],u_y[mm]\n1,2,3\n", "different units"},
        {"X[m],weight,volume[m]\n1,2,3\n", "weights are given twice"},
        {"X[m],weight\n1,-2\n", "weight of point 0 is -2"},
        {"X[m],\n1,2\n", "column 2 has no name"},
        {"X[m],t[s]\n1,2\n1,3\n", "line 3: column t has 3"},
        {"# time = soon\nX[m]\n1\n", "line 1: time = soon"},
        {"# time = 1e999 s\nX[m]\n1\n", "line 1: time"},
        {"# h = -1 m\nX[m]\n1\n", "expected a spacing above 0"},
        {"# n = 2.5\nX[m]\n1\n", "expected a whole number above 0"},
        {"X[m],a_name_that_is_so_long_that_there_is_no_room_for_it_in_sixty_four_bytes[m]\n1,2\n",
         "has no name of 1 to"},
        {"X[m],u_x[a unit that is far too long to be kept]\n1,2\n", "too long"},
        {"X[m],u_x[m]\n", "neither HDF5 nor XML"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        sample_refused_text(wrong[i].text, wrong[i].words);
    }
    sample_refused("X[m]\n1\n\0", 8, "neither HDF5");
}

static void units(void)
{
    static const struct {
        const char *given, *wanted;
        double factor; /* 0: refused */
    } known[] = {
        {"m", "m", 1},
        {"mm", "m", 1e-3},
        {"um", "m", 1e-6},
        {"\xc2\xb5m", "m", 1e-6},
        {"km", "m", 1e3},
        {"cm", "m", 1e-2},
        {"dm", "m", 1e-1},
        {"MPa", "Pa", 1e6},
        {"GPa", "Pa", 1e9},
        {"TPa", "Pa", 1e12},
        {"N/m^2", "Pa", 1},
        {"kN/m^2", "Pa", 1e3},
        {"ms", "s", 1e-3},
        {"ns", "s", 1e-9},
        {"mm/s", "m/s", 1e-3},
        {"-", "-", 1},
        {"1", "-", 1},
        {"", "-", 1},
        {"kg/m^2/s", "kg/(m^2 s)", 1},
        {"kJ/kg", "J/kg", 1e3},
        {"kN/m^3", "N/m^3", 1e3},
        {"inch", "m", 0},
        {"psi", "Pa", 0},
        {"m", "s", 0},
        {"Pa", "m", 0},
        {"", "m", 0},
        {"m/s", "m", 0},
        {"mm^2", "m^2", 0},
        {"mkg/m^3", "kg/m^3", 0},
        {"m-", "-", 0},
        {"min", "s", 0},
        {"mmm", "m", 0},
        {"xm", "m", 0},
        {"mm/ms", "m/s", 0},
        {"bar", "Pa", 0},
        {"%", "-", 0},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        double factor = NAN;
        bool fits = verify_unit_factor(known[i].given, known[i].wanted, &factor);
        if (fits != (known[i].factor != 0)) {
            printf("%s for %s\n", known[i].given, known[i].wanted);
        }
        CU_ASSERT_EQUAL(fits, known[i].factor != 0);
        CU_ASSERT_TRUE(!fits || factor == known[i].factor);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"takes all there is", takes_all_there_is},
        {"takes numbers from columns", takes_numbers_from_columns},
        {"without a last line end", without_a_last_line_end},
        {"refuses", refuses},
        {"units", units},
    };
    return sample_files_end(unit_main("verify: samples from tables", tests, sizeof tests / sizeof *tests));
}
