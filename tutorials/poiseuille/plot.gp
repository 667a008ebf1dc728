# Velocity over height at the four times of compare.py: particles of runs/64 (points), series (lines). Writes runs/profiles.png.
set terminal pngcairo size 900,600 font ",11"
set output 'runs/profiles.png'
set datafile separator comma
set datafile columnheaders
nu = 1e-6; L = 1e-3; F = 1e-4
y(z) = z/L + 0.5
u(z, t) = 0.5*y(z)*(1 - y(z)) - sum [n=0:50] 4/((2*n + 1)*pi)**3*sin((2*n + 1)*pi*y(z))*exp(-((2*n + 1)*pi)**2*nu*t/L**2)
file = 'runs/64/postProcessing/profile/profile.csv'
slabs = 64
array look[4] = [1, 2, 4, 10]                    # multiples of 0.05 s
set key right top; set xlabel 'u nu/(F L^2)'; set ylabel 'z/L'
set parametric; set trange [-0.5:0.5]; set samples 400; set yrange [-0.5:0.5]; set xrange [0:0.15]
plot for [i=1:4] file using (column('u_m_s')*nu/(F*L**2)):(column('position_m')/L) every ::slabs*look[i]::slabs*look[i]+slabs-1 with points pt 6 lc i title sprintf('t = %.2f s', 0.05*look[i]), \
     for [i=1:4] u(t*L, 0.05*look[i]), t with lines lc i notitle
