#include "render/lab.h"

#include <math.h>

/* sRGB primaries to CIE XYZ (IEC 61966-2-1); the row sums are the D65 white. */
static const double xyz_from_rgb[3][3] = {
    {0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}};
static const double rgb_from_xyz[3][3] = {
    {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};
static const double white[3] = {0.9504700, 1.0000001, 1.0888300};

/* CIE 15: the cube root, with a straight line below this cube so that black has a finite slope. */
static const double knee = 6.0 / 29;

static double compress(double ratio)
{
    return ratio > knee * knee * knee ? cbrt(ratio) : ratio / (3 * knee * knee) + 4.0 / 29;
}

static double expand(double root)
{
    return root > knee ? root * root * root : 3 * knee * knee * (root - 4.0 / 29);
}

static double linear_light(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

static double encode(double light)
{
    return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055;
}

void render_lab_from_rgb(const uint8_t rgb[3], float lab[3])
{
    double light[3], f[3];
    for (int c = 0; c < 3; c++)
        light[c] = linear_light(rgb[c] / 255.0);
    for (int i = 0; i < 3; i++) {
        double xyz = 0;
        for (int c = 0; c < 3; c++)
            xyz += xyz_from_rgb[i][c] * light[c];
        f[i] = compress(xyz / white[i]);
    }
    lab[0] = (float)(116 * f[1] - 16);
    lab[1] = (float)(500 * (f[0] - f[1]));
    lab[2] = (float)(200 * (f[1] - f[2]));
}

bool render_lab_to_rgb(const double lab[3], double rgb[3])
{
    const double level = (lab[0] + 16) / 116;
    const double f[3] = {level + lab[1] / 500, level, level - lab[2] / 200};
    bool inside = true;
    for (int c = 0; c < 3; c++) {
        double light = 0;
        for (int i = 0; i < 3; i++)
            light += rgb_from_xyz[c][i] * white[i] * expand(f[i]);
        /* Half a byte of slack: what rounds to a representable colour is one. */
        rgb[c] = encode(light);
        inside = inside && rgb[c] >= -0.5 / 255 && rgb[c] <= 1 + 0.5 / 255;
        rgb[c] = fmin(fmax(rgb[c], 0), 1);
    }
    return inside;
}

float render_delta_e(const float one[3], const float other[3])
{
    const float dL = one[0] - other[0], da = one[1] - other[1], db = one[2] - other[2];
    return sqrtf(dL * dL + da * da + db * db);
}
