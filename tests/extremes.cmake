# Extremes: where schemes work, held to what is asked of them, and that the map notices what does not.
foreach(extreme scale place alternating poisson perturbed small spin)
  assay_test(extremes-${extreme} LABELS stability gate COMMAND $<TARGET_FILE:assay> extremes ${extreme})
endforeach()
# These close in on where runs break down, by runs that do.
foreach(extreme stretch impact contrast slanted graded)
  assay_test(extremes-${extreme} LABELS stability gate UNTRAPPED "runs break down" COMMAND $<TARGET_FILE:assay> extremes
    ${extreme})
endforeach()
assay_test(extremes-cfl LABELS stability gate slow UNTRAPPED "runs break down" COMMAND $<TARGET_FILE:assay> extremes cfl)
assay_test(extremes-vibration LABELS stability gate slow COMMAND $<TARGET_FILE:assay> extremes vibration)
# Where the same runs are made to go wrong the rows say so: too large steps, velocities where there should be none, an
# angular momentum that may drift, a density that one row alone thinks other, a linear law, which takes a turn for strain,
# and an integrator that gains energy where nothing is dissipated. For cfl see the mutants (mustfail.cmake).
set(cli sh ${CMAKE_CURRENT_SOURCE_DIR}/cli.sh)
foreach(row "poisson;11;cfl=2" "stretch;16;cfl=3" "perturbed;7;cfl=2" "impact;7;cfl=2" "contrast;8;cfl=2"
        "slanted;14;cfl=3" "graded;4;cfl=8"
        "small;25;speed=1e-3;--set;integrator=euler" "spin;3;angular_momentum=free" "scale;6;material.rho=1e3"
        "place;12;material.model=linear-elastic" "vibration;1;integrator=tvd-rk2;--set;cfl=0.1;no dissipation")
  list(POP_FRONT row extreme failing)
  set(untrapped UNTRAPPED "runs break down")
  if(extreme MATCHES "^(spin|scale)$")
    set(untrapped "")
  endif()
  assay_test(extremes-notice-${extreme} LABELS stability mustfail ${untrapped} COMMAND ${cli} 1 "${failing} of these fail"
    $<TARGET_FILE:assay> extremes ${extreme} --set ${row})
endforeach()
# Without its dissipation JST lets the alternating mode live.
assay_test(extremes-notice-no-damping LABELS stability mustfail COMMAND ${cli} 1
  "48 of these fail" $<TARGET_FILE:assay> extremes alternating --set jst.kappa4=0 --set scheme=jst)
assay_test(extremes-know-their-names LABELS unit COMMAND ${cli} 2
  "did you mean scale" $<TARGET_FILE:assay> extremes scales)
# The help names them all, as the refusal does, which takes its list from the table.
assay_test(extremes-in-the-help LABELS unit COMMAND sh -c
  "for name in $($<TARGET_FILE:assay> extremes none 2>&1 | sed 's/.*there are //' | tr -d ,)
   do $<TARGET_FILE:assay> extremes --help | grep -w $name || exit 1
   done")
# What single precision rounds is told from what a place or a turn changes.
assay_test(extremes-place-single LABELS stability gate COMMAND $<TARGET_FILE:assay> extremes place --set precision=single)
# No row is measured with words that are wrong, or that say something else than the row does; the report is there or not.
foreach(row "unknown-key;unknown key;impact;--set;nonsense=1" "wrong-value;expected one of;impact;--set;scheme=xyz"
        "no-row;no row is of anything;impact;4D" "single;moves particles as fast;stretch;--set;precision=single"
        "driven-key;sets this key itself;perturbed;--set;perturb=0.1"
        "no-folder;test-out/none/extremes.json;impact;--json;test-out/none/extremes.json")
  list(POP_FRONT row name text)
  assay_test(extremes-refuse-${name} LABELS mustfail COMMAND ${cli} 2 ${text} $<TARGET_FILE:assay> extremes ${row})
endforeach()
