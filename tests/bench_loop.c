/* The limit for `make bench`: the same filters as plain C loops, as one would write them for exactly this work. */
#include <math.h>

/* one state, one sensor, F = H = 1: x and P of every step; drive = B u */
void number(int T, const double *z, double drive, double Q, double R, double x, double P, double *xs, double *Ps)
{
    for (int k = 0; k < T; k++) {
        double P_pred = P + Q, K = P_pred / (P_pred + R);
        x += drive;
        x += K * (z[k] - x);
        P = K * R;
        xs[k] = x;
        Ps[k] = P;
    }
}

/* and its Rauch-Tung-Striebel smoother, in place */
void number_rts(int T, double drive, double Q, double *xs, double *Ps)
{
    for (int k = T - 2; k >= 0; k--) {
        double P_pred = Ps[k] + Q, G = Ps[k] / P_pred;
        xs[k] += G * (xs[k + 1] - xs[k] - drive);
        Ps[k] += G * (Ps[k + 1] - P_pred) * G;
    }
}

/* many runs, z (T, runs): they share K */
void number_runs(int T, int runs, const double *z, double drive, double Q, double R, double P, double *xs)
{
    for (int k = 0; k < T; k++) {
        double P_pred = P + Q, K = P_pred / (P_pred + R);
        const double *before = k ? xs + (long)(k - 1) * runs : 0;
        const double *zk = z + (long)k * runs;
        double *xk = xs + (long)k * runs;
        P = K * R;
        for (int r = 0; r < runs; r++) {
            double x_pred = (before ? before[r] : 0) + drive;
            xk[r] = x_pred + K * (zk[r] - x_pred);
        }
    }
}

struct two { double x0, x1, P00, P01, P11, K0, K1; };

/* F = [1 a; 0 1], H = [1 0], Q diagonal; the gain and P */
static inline void gain(struct two *s, double a, double Q0, double Q1, double R)
{
    double p01 = s->P01 + a * s->P11, p00 = s->P00 + a * (s->P01 + p01) + Q0, p11 = s->P11 + Q1, S = p00 + R;
    s->K0 = p00 / S;
    s->K1 = p01 / S;
    s->P00 = s->K0 * R;
    s->P01 = s->K1 * R;
    s->P11 = p11 - s->K1 * p01;
}

/* one series, z and R and drive with a stride (the axes of an attitude); Rs of one value if fixed; P as (T, 3) */
void two(int T, int stride, const double *z, const double *Rs, int R_in_time, const double *drive, double a, double Q0,
         double Q1, double P00, double P11, double *xs, double *Ps)
{
    struct two s = {0, 0, P00, 0, P11, 0, 0};
    for (int k = 0; k < T; k++) {
        gain(&s, a, Q0, Q1, R_in_time ? Rs[k] : Rs[0]);
        s.x0 += a * s.x1 + (drive ? drive[(long)k * stride] : 0);
        double y = z[(long)k * stride] - s.x0;
        s.x0 += s.K0 * y;
        s.x1 += s.K1 * y;
        xs[(long)k * 2 * stride] = s.x0;
        xs[(long)k * 2 * stride + 1] = s.x1;
        double *P = Ps + (long)k * 3 * stride;
        P[0] = s.P00; P[1] = s.P01; P[2] = s.P11;
    }
}

/* the smoother of one series or (runs > 1) of many, xs (T, 2, runs), P (T, 3); in place */
void two_rts(int T, int runs, double a, double Q0, double Q1, double *xs, double *Ps)
{
    for (int k = T - 2; k >= 0; k--) {
        double *P = Ps + 3L * k, *N = P + 3;
        double f01 = P[1] + a * P[2], p00 = P[0] + a * (P[1] + f01) + Q0, p11 = P[2] + Q1, p01 = f01;
        double det = p00 * p11 - p01 * p01, A00 = P[0] + a * P[1], A10 = P[1] + a * P[2];
        double g00 = (A00 * p11 - P[1] * p01) / det, g01 = (P[1] * p00 - A00 * p01) / det;
        double g10 = (A10 * p11 - P[2] * p01) / det, g11 = (P[2] * p00 - A10 * p01) / det;
        double d00 = N[0] - p00, d01 = N[1] - p01, d11 = N[2] - p11;
        double h00 = g00 * d00 + g01 * d01, h01 = g00 * d01 + g01 * d11, h10 = g10 * d00 + g11 * d01, h11 = g10 * d01 + g11 * d11;
        P[0] += h00 * g00 + h01 * g01;
        P[1] += h00 * g10 + h01 * g11;
        P[2] += h10 * g10 + h11 * g11;
        double *x0 = xs + 2L * k * runs, *x1 = x0 + runs, *n0 = x1 + runs, *n1 = n0 + runs;
        for (int r = 0; r < runs; r++) {
            double e0 = n0[r] - (x0[r] + a * x1[r]), e1 = n1[r] - x1[r];
            x0[r] += g00 * e0 + g01 * e1;
            x1[r] += g10 * e0 + g11 * e1;
        }
    }
}

/* many runs, z (T, runs) -> xs (T, 2, runs), Ps (T, 3): they share K */
void two_runs(int T, int runs, const double *z, double R, double a, double Q0, double Q1, double P00, double P11,
              double *xs, double *Ps)
{
    struct two s = {0, 0, P00, 0, P11, 0, 0};
    for (int k = 0; k < T; k++) {
        gain(&s, a, Q0, Q1, R);
        const double *zk = z + (long)k * runs;
        double *x0 = xs + 2L * k * runs, *x1 = x0 + runs, *b0 = x0 - 2L * runs, *b1 = x0 - runs;
        for (int r = 0; r < runs; r++) {
            double v = k ? b1[r] : 0, d = (k ? b0[r] : 0) + a * v, y = zk[r] - d;
            x0[r] = d + s.K0 * y;
            x1[r] = v + s.K1 * y;
        }
        Ps[3L * k] = s.P00; Ps[3L * k + 1] = s.P01; Ps[3L * k + 2] = s.P11;
    }
}

/* the beetle: extended filter of [d, theta, v], z (T, runs), x (T, 3, runs) */
void beetle(int T, int runs, const double *z, double dt, const double *start, const double *P0, const double *Q, double R,
            double *xs)
{
    for (int r = 0; r < runs; r++) {
        double d = start[0], th = start[1], v = start[2];
        double P00 = P0[0], P01 = 0, P02 = 0, P11 = P0[1], P12 = 0, P22 = P0[2];
        for (int k = 0; k < T; k++) {
            double c = dt * cos(th), b = -dt * v * sin(th);
            d += v * c;
            double f1 = P01 + b * P11 + c * P12, f2 = P02 + b * P12 + c * P22;
            P00 += b * P01 + c * P02 + b * f1 + c * f2 + Q[0];
            P01 = f1; P02 = f2; P11 += Q[1]; P22 += Q[2];
            double S = P00 + R, K0 = P00 / S, K1 = P01 / S, K2 = P02 / S, y = z[(long)k * runs + r] - d;
            d += K0 * y; th += K1 * y; v += K2 * y;
            P11 -= K1 * P01; P12 -= K1 * P02; P22 -= K2 * P02;
            P00 = K0 * R; P01 = K1 * R; P02 = K2 * R;
            double *x = xs + 3L * k * runs + r;
            x[0] = d; x[runs] = th; x[2 * runs] = v;
        }
    }
}
