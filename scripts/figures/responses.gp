# Responses of three settings to both unit steps (compare Huba2022, Figure 11).
set datafile separator ","
set terminal svg size 1100,760 font "Helvetica,14" background "white"
set output "demo/responses.svg"
set multiplot layout 2,2 title "DIPDT, ideal PID: unit setpoint step (left), unit input disturbance (right)"
set xrange [0:60]
set xlabel "time in dead times"
set key right bottom
set style line 1 lw 2.5 lc rgb "#0072b2"
set style line 2 lw 2.5 lc rgb "#d55e00" dt 2
set style line 3 lw 2.5 lc rgb "#009e73" dt 4
do for [signal in "y_w y_d u_w u_d"] {
  set ylabel (signal[1:1] eq "y" ? "output y" : "controller output u")
  if (signal[3:3] eq "d" && signal[1:1] eq "y") { set key right top } else { set key right bottom }
  plot "demo/ppm47.csv" using "t":signal with lines ls 1 title "portrait, (47)", \
       "demo/ppm48.csv" using "t":signal with lines ls 2 title "portrait, (48)", \
       "demo/qrdp.csv" using "t":signal with lines ls 3 title "QRDP, (22)"
}
unset multiplot
