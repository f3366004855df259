//! The tests of the simulated CNC in `tests/simulator/` that verify requirements, with the
//! requirements of each.

use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

/// The test that runs the golden sequences of data streaming and of the Service Interface.
pub const SEQUENCES: &str = "the_simulated_cnc_goes_through_each_golden_sequence";

/// The other tests, each with its requirements.
#[rustfmt::skip]
pub const SIMULATOR_CHECKS: &[(&str, &[ClauseId])] = &[
    ("an_axis_takes_its_values_to_another_place", &[ADR_13, SDA_11, SDA_13, VAR_10]),
    ("a_place_without_an_axis_is_blank", &[SDA_11]),
    ("names_and_handles_of_a_place_are_of_its_axis", &[VAR_10, VAR_26]),
    ("ranks_are_those_of_the_active_channels", &[ADR_11]),
    ("contents_are_read_at_their_addresses", &[
        ADR_1, ADR_2, ADR_3, ADR_5, ADR_6, ADR_7, ADR_12, ADR_13, COM_4, COM_5, GEN_1, GEN_6,
    ]),
    ("a_write_changes_its_content_alone", &[
        ADR_1, ADR_2, ADR_3, ADR_5, ADR_6, ADR_7, ADR_12, ADR_13, COM_5, GEN_1, GEN_6,
    ]),
    ("every_object_is_in_its_list", &[COM_2, OBJ_1]),
    ("elements_have_the_attributes_of_their_contents", &[ADR_6, GEN_3, OBJ_1]),
    ("each_task_has_the_information_of_the_program", &[ADS_8, ADS_9]),
    ("errors_have_their_numbers", &[ADS_4, ADS_5, ADS_6, ADS_7]),
    ("each_query_has_its_own_answer", &[
        ADR_1, ADR_7, ADR_11, ADR_12, ADS_1, ADS_3, ADS_4, COM_1, COM_2, COM_5, DYN_1, DYN_2, DYN_3, DYN_4,
        SDA_1,
        SDA_4, VAR_2, VAR_4, VAR_10, VAR_11, VAR_14, VAR_15, VAR_26, VAR_28,
    ]),
    ("a_request_is_over_when_it_is_answered", &[SVC_3, SVC_4]),
    ("each_variable_is_its_own", &[SVC_1, SVC_3, SVC_5]),
    ("an_answer_changes_no_other_channel", &[SVC_1, SVC_4]),
    ("a_program_writes_its_state_last", &[SVC_12]),
    ("each_channel_executes_its_own_stream", &[STM_1, ADR_12]),
    ("lines_are_executed_as_written", &[STM_4, STM_7]),
    ("packets_of_any_length_are_executed", &[STM_2, STM_4]),
    ("a_packet_that_is_too_long_takes_no_room", &[STM_2]),
    ("many_packets_fill_the_interface", &[STM_3, STM_6, STM_15]),
    ("each_channel_has_its_own_room", &[STM_3, STM_12]),
    ("a_packet_without_room_is_rejected_whole", &[STM_3, STM_6]),
    ("all_packets_are_read_at_once", &[STM_12]),
    ("a_packet_that_is_sent_twice_is_executed_twice", &[STM_4, STM_15]),
    ("lines_written_after_a_program_end_stay", &[STM_10, STM_14]),
    ("a_reset_ends_the_program", &[STM_11, STM_14]),
    ("loops_and_jumps_back_end_streaming", &[STM_8, STM_9]),
    ("branches_may_span_packets", &[STM_8, STM_19]),
    ("comments_hide_words", &[STM_8, STM_9]),
    ("four_words_end_the_program", &[STM_9, STM_10]),
    ("variables_are_described_as_configured", &[
        VAR_2, VAR_3, VAR_4, VAR_5, VAR_6, VAR_7, VAR_8, VAR_14, VAR_15, VAR_16, GEN_3,
    ]),
    ("values_have_their_lowest_byte_first", &[GEN_1]),
    ("variables_without_a_handle_are_written_by_name", &[VAR_18]),
    ("parameters_come_and_go", &[DYN_1, DYN_2, DYN_3, DYN_4, DYN_5, DYN_6]),
];
