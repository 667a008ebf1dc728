# Angle of the spheroid's axis over strain: runs (points) and Jeffery (line). Writes runs/phi.png.
set terminal pngcairo size 900,600 font ",11"
set output 'runs/phi.png'
set datafile separator comma
set datafile columnheaders
r = 0.5
turned(x, z) = atan2(x, z) < -0.1 ? atan2(x, z) + 2*pi : atan2(x, z)        # the axis turns by half a turn and little more
jeffery(s) = s < pi*(r + 1/r) ? atan2(r*sin(s/(r + 1/r)), cos(s/(r + 1/r))) : 1/0
file(name) = 'runs/'.name.'/postProcessing/motion/body.csv'
start = 0.5*pi*(r + 1/r)                                                    # strain at which Jeffery's axis passes the flow
set key left top; set xlabel 'strain'; set ylabel 'phi, degrees'; set xrange [0:8]; set yrange [0:190]; set ytics 45; set samples 400
plot file('turn') using 'strain':(turned(column('axis_x'), column('axis_z'))*180/pi) every 10 with points pt 6 title 'dmpFlow, 8 particles along the diameter', \
     file('gradient') using 'strain':(turned(column('axis_x'), column('axis_z'))*180/pi) with lines lw 4 title '16 along the diameter', \
     file('flow') using (column('strain') + start):(turned(column('axis_x'), column('axis_z'))*180/pi) with lines lw 4 title '16, from the axis along the flow', \
     jeffery(x)*180/pi with lines lc 'black' title 'Jeffery'
