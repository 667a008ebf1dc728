# Deformation index and angle of the cell over strain.  gnuplot -c shape.gp OUT.png REFERENCE FILE.csv...
# FILE: postProcessing/deformation/rbc.csv. REFERENCE: strain,D12_extent,D12_inertia,angle_deg; or none.
out = ARG1; reference = ARG2; files = ARG3
do for [i=4:ARGC] { files = files . ' ' . value('ARG' . i) }
set terminal pngcairo size 1200,500 font ",11"
set output out
set datafile separator comma
set datafile columnheaders
set xlabel 'strain' offset 0,0.3
set bmargin at screen 0.3
# As far as the run has come; a reference may go on.
set xrange [0:real(system("awk -F, '/^#/ {next} /^time_s/ {for (k = 1; k <= NF; ++k) if ($k == \"strain\") at = k; next} " \
                          . "$at + 0 > last {last = $at} END {print last}' " . files))]
set key below
degrees = 180/pi
# The main axis has no direction: its angle is followed from look to look; at strain 0 it lies along the flow.
last = 0
followed(strain, angle) = (last = strain > 0 ? last : 0, last = angle + 180*floor((last - angle)/180 + 0.5), last)
given = reference ne 'none'
D12ofReference = !given ? '' : ", reference using 'strain':'D12_extent' every 3 with points pt 6 lc 1 title 'extents, boundary elements'" \
                             . ", reference using 'strain':'D12_inertia' every 3 with points pt 6 lc 2 title 'inertia, boundary elements'"
angleOfReference = !given ? '' : ", reference using 'strain':'angle_deg' every 3 with points pt 6 lc 2 title 'main axis, boundary elements'"
# Rigid cell of Kuchel and Fackerell's shape in unbounded Stokes flow, period 20.45: that of a spheroid of axis ratio r (Jeffery 1922).
r = 0.3435
rigid(t) = (phase = t*r/(1 + r*r), degrees*(atan(r*tan(phase)) + pi*floor(phase/pi + 0.5)))
rigidCell = !given ? '' : ", rigid(x) with lines dt 2 lc 'gray40' title 'rigid cell, unbounded'"
set multiplot layout 1,2
set ylabel 'D12'
plot for [f in files] f using 'strain':'D12_extent' with lines lw 2 lc 1 title 'by extents', \
     for [f in files] f using 'strain':'D12_inertia' with lines lw 2 lc 2 title 'by inertia' @D12ofReference
set ylabel 'degrees, with the flow'
plot for [f in files] f using 'strain':(column('angleTurned_rad')*degrees) with lines lw 2 lc 1 title 'angle turned by the material', \
     for [f in files] f using 'strain':(followed(column('strain'), -column('inclination_rad')*degrees)) with lines lw 2 lc 2 title 'main axis' \
     @rigidCell @angleOfReference
unset multiplot
