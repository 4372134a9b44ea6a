#include "verify/html.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

void verify_html_text(FILE *file, const char *text)
{
    for (const char *c = text; *c != '\0'; c++) {
        switch (*c) {
        case '&':
            (void)fputs("&amp;", file);
            break;
        case '<':
            (void)fputs("&lt;", file);
            break;
        case '>':
            (void)fputs("&gt;", file);
            break;
        case '"':
            (void)fputs("&quot;", file);
            break;
        default:
            (void)fputc(*c, file);
        }
    }
}

static void base64(FILE *file, const unsigned char *bytes, size_t size)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t rest = size - i;
        uint32_t three = (uint32_t)bytes[i] << 16;
        three |= rest > 1 ? (uint32_t)bytes[i + 1] << 8 : 0;
        three |= rest > 2 ? (uint32_t)bytes[i + 2] : 0;
        (void)fputc(digit[three >> 18], file);
        (void)fputc(digit[three >> 12 & 63], file);
        (void)fputc(rest > 1 ? digit[three >> 6 & 63] : '=', file);
        (void)fputc(rest > 2 ? digit[three & 63] : '=', file);
    }
}

bool verify_html_picture(FILE *file, const char *path, const char *caption, struct solver_error *error)
{
    char *bytes = NULL;
    size_t size = 0;
    if (path[0] == '\0') {
        return true;
    }
    if (!verify_file_read(path, &bytes, &size, error)) {
        return false;
    }
    (void)fprintf(file, "<figure><img alt=\"%s\" src=\"data:image/png;base64,", caption);
    base64(file, (const unsigned char *)bytes, size);
    (void)fprintf(file, "\"><figcaption class=\"note\">%s</figcaption></figure>\n", caption);
    free(bytes);
    return true;
}

void verify_html_cell(FILE *file, const char *format, double value)
{
    (void)fputs("<td>", file);
    if (isnan(value)) {
        (void)fputs("&ndash;", file);
    } else {
        (void)fprintf(file, format[0] == 'e' ? "%.3e" : "%.2f", value);
    }
    (void)fputs("</td>", file);
}

void verify_html_number(FILE *file, double value)
{
    if (isnan(value)) {
        (void)fputs("<td>&ndash;</td>", file);
    } else {
        (void)fprintf(file, "<td>%.9g</td>", value);
    }
}
