# Frames measures/grains_*.csv of one disc in a row: time,height (of its lowest point),velocity.
BEGIN { FS = ","; print "time,height,velocity" }
/^# time/ { split($0, words, " "); time = words[3] }
/^[0-9]/ { print time "," $3 - $6 "," $5 }
