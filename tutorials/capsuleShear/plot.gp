# Deformation, inclination and area over strain, beside boundary elements: postProcessing/shape.png
set terminal pngcairo size 1200,450 font ",11"
set output 'postProcessing/shape.png'
set datafile separator comma
set datafile columnheaders
set xlabel 'strain'
set key bottom right
table = "postProcessing/deformation/capsule.csv"
set multiplot layout 1,2
set ylabel 'D12 by inertia'
plot table using 'strain':'D12_inertia' with lines lw 2 lc 2 title 'this case', \
     'reference.csv' using 'strain':'D12_inertia' every 3 with points pt 6 lc 2 title 'boundary elements, unbounded'
set key top right
set ylabel 'inclination, degrees'
plot table using 'strain':(column('inclination_rad')*180/pi) with lines lw 2 lc 2 title 'this case', \
     'reference.csv' using 'strain':'inclination_deg' every 3 with points pt 6 lc 2 title 'boundary elements, unbounded'
unset multiplot
