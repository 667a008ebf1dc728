# Length of the tears, area of the holes and fluid released over strain. Writes postProcessing/rupture.png.
set terminal pngcairo size 1200,400 font ",11"
set output 'postProcessing/rupture.png'
set datafile separator comma
set datafile columnheaders
table = 'postProcessing/rupture/rbc.csv'
set xlabel 'strain'; unset key; set yrange [0:*]; set offsets 0, 0, graph 0.05, 0
set multiplot layout 1,3
set ylabel 'length of the tears [um]'
plot table using 'strain':(1e6*column('tearLength_m')) with lines lw 2 lc 1
set ylabel 'area of the holes [um^2]'
plot table using 'strain':(1e12*column('holeArea_m2')) with lines lw 2 lc 1
set ylabel 'fluid released from inside [fL]'
plot table using 'strain':(1e18*column('releasedVolume_m3')) with lines lw 2 lc 1
unset multiplot
