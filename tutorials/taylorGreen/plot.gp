# Kinetic energy over time: runs/16, 32, 64 (points), exact decay (line). Writes runs/decay.png.
set terminal pngcairo size 900,600 font ",11"
set output 'runs/decay.png'
set datafile separator comma
set datafile columnheaders
nu = 1e-6; k = 2*pi/1e-3
file(N) = "runs/" . N . "/postProcessing/balance/conservation.csv"
# With digits behind the point: gnuplot takes no "2e-9" for a number.
first(N) = real(system("awk -F, '/^#/ {next} /^time_s/ {for (k = 1; k <= NF; ++k) if ($k == \"kineticEnergy_J\") at = k; next} " \
                       . "{printf \"%.9e\", $at; exit}' " . file(N)))
set xlabel '4 nu k^2 t'; set ylabel 'E/E(0)'; set logscale y; set xrange [0:3.2]; set yrange [0.03:1.2]
plot for [N in "16 32 64"] E = first(N) file(N) using (4*nu*k**2*column('time_s')):(column('kineticEnergy_J')/E) with points title N . ' along a wavelength', \
     exp(-x) with lines lc 'black' title 'exact'
