# Velocity over height at the four times of compare.py: particles of runs/64 (points), series (lines). Writes runs/profiles.png.
set terminal pngcairo size 900,600 font ",11"
set output 'runs/profiles.png'
set datafile separator comma
set datafile columnheaders
nu = 1e-6; L = 1e-3; U = 6.25e-6
u(z, t) = 2*z/L + sum [n=1:100] 2/(n*pi)*(-1)**n*sin(2*n*pi*z/L)*exp(-4*n**2*pi**2*nu*t/L**2)
file = 'runs/64/postProcessing/profile/profile.csv'
slabs = 64
array look[4] = [1, 2, 5, 10]                    # multiples of 0.0225 s
set key left top; set xlabel 'u/U'; set ylabel 'z/L'
set parametric; set trange [-0.5:0.5]; set samples 400; set yrange [-0.5:0.5]; set xrange [-1:1]
plot for [i=1:4] file using (column('u_m_s')/U):(column('position_m')/L) every ::slabs*look[i]::slabs*look[i]+slabs-1 with points pt 6 lc i title sprintf('t = %.4f s', 0.0225*look[i]), \
     for [i=1:4] u(t*L, 0.0225*look[i]), t with lines lc i notitle
