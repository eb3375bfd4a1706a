#include "pose/turn.h"

/* Four times the product of the largest component with each of the four is a sum of two matrix entries (or three, for
 * its square); dividing by the largest one keeps the digits. */
rg_turn rg_turn_from_matrix(const rg_mat3 *R, rg_turn before)
{
    const rg_vec3 a = R->c[0], b = R->c[1], c = R->c[2];
    const double w = 1 + a.x + b.y + c.z, x = 1 + a.x - b.y - c.z, y = 1 - a.x + b.y - c.z, z = 1 - a.x - b.y + c.z;
    rg_turn q;
    if (w >= x && w >= y && w >= z) q = (rg_turn){b.z - c.y, c.x - a.z, a.y - b.x, w};
    else if (x >= y && x >= z) q = (rg_turn){x, b.x + a.y, c.x + a.z, b.z - c.y};
    else if (y >= z) q = (rg_turn){b.x + a.y, y, c.y + b.z, c.x - a.z};
    else q = (rg_turn){c.x + a.z, c.y + b.z, z, a.y - b.x};
    double length = sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    if (q.x * before.x + q.y * before.y + q.z * before.z + q.w * before.w < 0) length = -length;
    return (rg_turn){q.x / length, q.y / length, q.z / length, q.w / length};
}
