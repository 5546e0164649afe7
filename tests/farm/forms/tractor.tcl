# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# tractor.tcl FILE [run]: reads a job script of Tractor's as Tcl does, with its operators and their options; counts them, or
# runs the commands in the order of a job whose tasks are serial.
set known {
    Job {-title -subtasks -serialsubtasks -service -atleast -priority -projects -tags -comment}
    Task {-title -subtasks -serialsubtasks -cmds -service -atleast}
    RemoteCmd {-service -atleast -tags -retryrc -envkey}
}
set blocks {-subtasks -cmds}
set runs [expr {[lindex $argv 1] eq "run"}]
array set count {Job 0 Task 0 RemoteCmd 0}

proc take {operator options} {
    global known blocks count
    incr count($operator)
    if {[llength $options] % 2} { error "$operator: an option without a value" }
    foreach {option value} $options {
        if {$option ni [dict get $known $operator]} { error "$operator has no option $option" }
        if {$option in $blocks} { uplevel #0 $value }
    }
}
proc Job args { take Job $args }
proc Task args { take Task $args }
proc RemoteCmd {launched args} {
    global runs
    take RemoteCmd $args
    if {$runs} { exec {*}$launched >@stdout 2>@stderr }
}

source [lindex $argv 0]
if {!$runs} { puts "$count(Job) jobs, $count(Task) tasks, $count(RemoteCmd) commands" }
