; raycast.comp, unshaded, hardware sampler, as RADV of Mesa 22.3.6 compiles it for navi21:
; from the first loop over the volume's bricks to the end, without the encoding.
BB46:
	s_mov_b64 exec, s[0:1]
	s_buffer_load_dwordx2 s[0:1], s[8:11], 0x50
	v_lshrrev_b64 v[28:29], 0, 1
	v_lshrrev_b64 v[30:31], 0, 0x3f800000
	v_lshrrev_b64 v[32:33], 0, 0
	s_mov_b64 s[16:17], exec
	s_mov_b64 s[24:25], 0
	s_mov_b64 s[26:27], 0
BB47:
	s_mov_b64 s[28:29], exec
	v_cmpx_ge_i32_e32 v29, v4
BB48:
	s_and_b64 s[26:27], s[26:27], exec
	s_or_b64 s[24:25], s[24:25], s[26:27]
	s_andn2_b64 s[28:29], s[28:29], exec
	s_cbranch_scc0 BB104
BB55:
	s_mov_b64 exec, s[28:29]
	s_and_saveexec_b64 s[26:27], vcc
	s_cbranch_execz BB90
BB56:
	s_mov_b64 s[28:29], exec
	s_mov_b64 s[30:31], 0
	s_mov_b64 s[32:33], 0
	s_mov_b64 s[34:35], s[4:5]
	s_mov_b64 s[36:37], s[12:13]
BB57:
	v_cmp_lt_i32_e64 s[38:39], v29, v4
	s_andn2_b64 s[38:39], s[38:39], s[36:37]
	s_and_saveexec_b64 s[38:39], s[38:39]
BB60:
	s_andn2_b64 exec, s[38:39], exec
BB61:
	s_and_b64 s[36:37], s[36:37], exec
	s_or_b64 s[32:33], s[32:33], s[36:37]
	s_and_b64 s[36:37], s[34:35], exec
	s_or_b64 s[30:31], s[30:31], s[36:37]
	s_andn2_b64 s[38:39], s[38:39], exec
	s_cbranch_scc0 BB72
BB65:
	s_mov_b64 exec, s[38:39]
	v_cvt_f32_i32_e32 v28, v4
	v_cmp_nlt_f32_e64 s[36:37], v27, v28
	s_or_b64 s[34:35], s[34:35], s[36:37]
	v_add_f32_e32 v28, -0.5, v27
	v_ceil_f32_e32 v28, v28
	v_cvt_i32_f32_e32 v28, v28
	v_max_i32_e32 v28, 0, v28
	v_min_i32_e32 v28, v28, v4
	v_cndmask_b32_e64 v28, v28, v4, s[34:35]
	v_max_i32_e32 v29, v29, v28
	v_cmp_ge_f32_e64 s[34:35], v27, v26
	v_cmp_ge_f32_e64 s[36:37], v27, v25
	s_and_b64 s[38:39], s[36:37], 0
	s_andn2_b64 s[34:35], s[34:35], s[36:37]
	s_or_b64 s[34:35], s[38:39], s[34:35]
	s_nor_b64 s[38:39], s[36:37], s[34:35]
	v_cndmask_b32_e64 v28, 0, 1, s[36:37]
	v_mul_lo_u32 v28, v17, v28
	v_cndmask_b32_e64 v25, 0, 1, s[34:35]
	v_mul_lo_u32 v25, v18, v25
	v_cndmask_b32_e64 v26, 0, 1, s[38:39]
	v_mul_lo_u32 v26, v19, v26
	v_add_nc_u32_e32 v15, v15, v28
	v_add_nc_u32_e32 v16, v16, v25
	v_add_nc_u32_e32 v7, v7, v26
	v_cvt_f32_i32_e32 v28, v15
	v_cvt_f32_i32_e32 v25, v16
	v_cvt_f32_i32_e32 v26, v7
	v_fma_f32 v27, v28, v22, v20
	v_fma_f32 v25, v25, v23, v21
	v_fma_f32 v26, v26, v24, v6
	v_min3_f32 v26, v27, v25, v26
	v_cmp_le_u32_e64 s[34:35], s22, v7
	v_cmp_le_u32_e64 s[36:37], s21, v16
	s_or_b64 s[34:35], s[34:35], s[36:37]
	v_cmp_le_u32_e64 s[36:37], s20, v15
	s_or_b64 s[34:35], s[34:35], s[36:37]
	v_mul_lo_u32 v28, s21, v7
	v_add_nc_u32_e32 v28, v16, v28
	v_mul_lo_u32 v28, s20, v28
	s_and_saveexec_b64 s[36:37], s[34:35]
BB66:
	v_mov_b32_e32 v28, 1
BB68:
	s_andn2_b64 exec, s[36:37], exec
	s_cbranch_execz BB71
BB69:
	s_load_dwordx4 s[40:43], s[2:3], 0xe0
	v_add_lshl_u32 v28, v15, v28, 2
	s_waitcnt lgkmcnt(0)
	buffer_load_dword v28, v28, s[40:43], 0 offen
BB71:
	s_mov_b64 exec, s[36:37]
	s_waitcnt vmcnt(0)
	v_cmp_ne_i32_e64 s[36:37], 0, v28
	v_mov_b32_e32 v28, 1
	v_swap_b32 v26, v25
	v_swap_b32 v25, v27
	s_branch BB57
BB72:
	s_mov_b64 exec, s[28:29]
	v_mov_b32_e32 v34, v29
	v_mov_b32_e32 v35, v28
	s_mov_b64 s[28:29], exec
	s_mov_b64 s[34:35], 0
	s_mov_b64 s[36:37], 0
BB73:
	v_cmp_lt_i32_e64 s[38:39], v34, v4
	s_and_b64 s[38:39], s[38:39], s[32:33]
	v_cmp_eq_i32_e64 s[40:41], v35, v28
	s_and_b64 s[38:39], s[38:39], s[40:41]
	v_cmp_lt_i32_e64 s[40:41], v29, v34
	v_cmp_eq_i32_e64 s[42:43], 2, v28
	s_nand_b64 s[40:41], s[42:43], s[40:41]
	s_and_b64 s[38:39], s[38:39], s[40:41]
	s_and_saveexec_b64 s[38:39], s[38:39]
BB76:
	s_andn2_b64 exec, s[38:39], exec
BB77:
	s_and_b64 s[32:33], s[32:33], exec
	s_or_b64 s[36:37], s[36:37], s[32:33]
	s_and_b64 s[32:33], s[30:31], exec
	s_or_b64 s[34:35], s[34:35], s[32:33]
	s_andn2_b64 s[38:39], s[38:39], exec
	s_cbranch_scc0 BB88
BB81:
	s_mov_b64 exec, s[38:39]
	v_cvt_f32_i32_e32 v35, v4
	v_cmp_nlt_f32_e64 s[32:33], v27, v35
	s_or_b64 s[30:31], s[30:31], s[32:33]
	v_add_f32_e32 v35, -0.5, v27
	v_ceil_f32_e32 v35, v35
	v_cvt_i32_f32_e32 v35, v35
	v_max_i32_e32 v35, 0, v35
	v_min_i32_e32 v35, v35, v4
	v_cndmask_b32_e64 v35, v35, v4, s[30:31]
	v_max_i32_e32 v34, v34, v35
	v_cmp_ge_f32_e64 s[30:31], v27, v26
	v_cmp_ge_f32_e64 s[32:33], v27, v25
	s_and_b64 s[38:39], s[32:33], 0
	s_andn2_b64 s[30:31], s[30:31], s[32:33]
	s_or_b64 s[30:31], s[38:39], s[30:31]
	s_nor_b64 s[38:39], s[32:33], s[30:31]
	v_cndmask_b32_e64 v25, 0, 1, s[32:33]
	v_mul_lo_u32 v25, v17, v25
	v_cndmask_b32_e64 v26, 0, 1, s[30:31]
	v_mul_lo_u32 v26, v18, v26
	v_cndmask_b32_e64 v27, 0, 1, s[38:39]
	v_mul_lo_u32 v27, v19, v27
	v_add_nc_u32_e32 v15, v15, v25
	v_add_nc_u32_e32 v16, v16, v26
	v_add_nc_u32_e32 v7, v7, v27
	v_cvt_f32_i32_e32 v25, v15
	v_cvt_f32_i32_e32 v26, v16
	v_cvt_f32_i32_e32 v27, v7
	v_fma_f32 v25, v25, v22, v20
	v_fma_f32 v26, v26, v23, v21
	v_fma_f32 v27, v27, v24, v6
	v_min3_f32 v27, v25, v26, v27
	v_cmp_le_u32_e64 s[30:31], s22, v7
	v_cmp_le_u32_e64 s[32:33], s21, v16
	s_or_b64 s[30:31], s[30:31], s[32:33]
	v_cmp_le_u32_e64 s[32:33], s20, v15
	s_or_b64 s[30:31], s[30:31], s[32:33]
	v_mul_lo_u32 v35, s21, v7
	v_add_nc_u32_e32 v35, v16, v35
	v_mul_lo_u32 v35, s20, v35
	s_and_saveexec_b64 s[32:33], s[30:31]
BB82:
	v_mov_b32_e32 v35, 1
BB84:
	s_andn2_b64 exec, s[32:33], exec
	s_cbranch_execz BB87
BB85:
	s_load_dwordx4 s[40:43], s[2:3], 0xe0
	v_add_lshl_u32 v35, v15, v35, 2
	s_waitcnt lgkmcnt(0)
	buffer_load_dword v35, v35, s[40:43], 0 offen
BB87:
	s_mov_b64 exec, s[32:33]
	s_waitcnt vmcnt(0)
	v_cmp_ne_i32_e64 s[32:33], 0, v35
	v_mov_b32_e32 v35, 1
	s_branch BB73
BB88:
	s_mov_b64 exec, s[28:29]
	v_mov_b32_e32 v28, v35
BB90:
	s_andn2_b64 exec, s[26:27], exec
	s_cbranch_execz BB92
BB91:
	s_andn2_b64 s[28:29], s[36:37], exec
	s_and_b64 s[12:13], s[12:13], exec
	s_or_b64 s[12:13], s[28:29], s[12:13]
	s_andn2_b64 s[28:29], s[34:35], exec
	s_and_b64 s[4:5], s[4:5], exec
	s_or_b64 s[4:5], s[28:29], s[4:5]
	v_mov_b32_e32 v34, v4
	s_branch BB93
BB92:
	s_mov_b64 s[4:5], s[34:35]
	s_mov_b64 s[12:13], s[36:37]
BB93:
	s_mov_b64 exec, s[26:27]
	v_cmp_lt_i32_e64 s[26:27], v29, v34
	v_cmp_eq_i32_e64 s[28:29], v34, v4
	s_and_b64 s[26:27], s[28:29], s[26:27]
	v_min_i32_e32 v34, v34, v5
	s_mov_b64 s[28:29], exec
	s_mov_b64 s[30:31], 0
BB94:
	s_mov_b64 s[32:33], exec
	v_cmpx_ge_i32_e32 v29, v34
	s_cbranch_execz BB102
BB95:
	s_and_b64 s[34:35], s[26:27], exec
	s_or_b64 s[30:31], s[30:31], s[34:35]
	s_andn2_b64 s[32:33], s[32:33], exec
	s_cbranch_scc1 BB102
BB96:
	s_mov_b64 s[26:27], s[30:31]
	s_branch BB103
BB102:
	s_mov_b64 exec, s[32:33]
	s_clause 0x2
	s_load_dwordx8 s[32:39], s[2:3], 0x20
	s_load_dwordx4 s[40:43], s[2:3], 0x70
	s_load_dwordx8 s[48:55], s[2:3], 0x80
	v_cvt_f32_i32_e32 v35, v29
	v_add_f32_e32 v35, 0.5, v35
	v_fma_f32 v36, v11, v35, v2
	v_fma_f32 v37, v13, v35, v3
	v_fma_f32 v35, v14, v35, v0
	v_mul_f32_e32 v38, v36, v8
	v_mul_f32_e32 v39, v37, v9
	v_mul_f32_e32 v40, v35, v10
	s_waitcnt lgkmcnt(0)
	image_sample_lz v35, v[38:40], s[32:39], s[40:43] dmask:0x1 dim:SQ_RSRC_IMG_3D
	s_waitcnt vmcnt(0)
	v_fma_f32 v35, s0, v35, s1
	v_fma_f32 v35, 0x43800000, v35, -0.5
	v_cmp_gt_f32_e64 s[32:33], 0x437f0000, v35
	v_cndmask_b32_e64 v36, 0x437f0000, v35, s[32:33]
	v_cmp_lt_f32_e64 s[32:33], 0, v35
	v_cndmask_b32_e64 v35, 0, v36, s[32:33]
	v_cvt_i32_f32_e32 v36, v35
	v_min_i32_e32 v36, 0xfe, v36
	v_add_nc_u32_e32 v37, 1, v36
	s_clause 0x1
	image_load v[40:43], v36, s[48:55] dmask:0xf dim:SQ_RSRC_IMG_1D unorm
	image_load v[44:47], v37, s[48:55] dmask:0xf dim:SQ_RSRC_IMG_1D unorm
	v_add_nc_u32_e32 v29, 1, v29
	v_cvt_f32_i32_e32 v36, v36
	v_sub_f32_e32 v35, v35, v36
	s_waitcnt vmcnt(0)
	v_sub_f32_e32 v44, v44, v40
	v_sub_f32_e32 v45, v45, v41
	v_sub_f32_e32 v46, v46, v42
	v_sub_f32_e32 v47, v47, v43
	v_fmac_f32_e32 v40, v44, v35
	v_fmac_f32_e32 v41, v45, v35
	v_fmac_f32_e32 v42, v46, v35
	v_fmac_f32_e32 v43, v47, v35
	v_mul_f32_e32 v44, v30, v43
	v_fma_f32 v45, v40, v44, v31
	v_fma_f32 v46, v41, v44, v32
	v_fma_f32 v47, v42, v44, v33
	v_sub_f32_e32 v44, v30, v44
	v_cmp_lt_f32_e64 s[32:33], 0, v43
	v_cndmask_b32_e64 v30, v30, v44, s[32:33]
	v_cndmask_b32_e64 v31, v31, v45, s[32:33]
	v_cndmask_b32_e64 v32, v32, v46, s[32:33]
	v_cndmask_b32_e64 v33, v33, v47, s[32:33]
	v_cmp_gt_f32_e64 s[32:33], s15, v30
	s_and_b64 s[34:35], s[32:33], 0
	s_andn2_b64 s[26:27], s[26:27], s[32:33]
	s_or_b64 s[26:27], s[34:35], s[26:27]
	v_cndmask_b32_e64 v4, v4, 0, s[32:33]
	v_cndmask_b32_e64 v34, v34, 0, s[32:33]
	s_branch BB94
BB103:
	s_mov_b64 exec, s[28:29]
	v_cndmask_b32_e64 v4, v4, 0, s[30:31]
	s_branch BB47
BB104:
	s_mov_b64 exec, s[16:17]
	s_and_saveexec_b64 s[4:5], s[24:25]
	s_cbranch_execz BB123
BB105:
	s_clause 0x2
	s_load_dwordx8 s[24:31], s[2:3], 0x20
	s_load_dwordx4 s[12:15], s[2:3], 0x70
	s_load_dwordx8 s[32:39], s[2:3], 0x80
	v_cvt_f32_i32_e32 v4, v5
	v_sub_f32_e32 v12, v12, v4
	v_add_f32_e32 v4, 0.5, v4
	v_fmac_f32_e32 v2, v11, v4
	v_fmac_f32_e32 v3, v13, v4
	v_fmac_f32_e32 v0, v14, v4
	v_mul_f32_e32 v6, v2, v8
	v_mul_f32_e32 v7, v3, v9
	v_mul_f32_e32 v8, v0, v10
	s_waitcnt lgkmcnt(0)
	image_sample_lz v0, v[6:8], s[24:31], s[12:15] dmask:0x1 dim:SQ_RSRC_IMG_3D
	s_waitcnt vmcnt(0)
	v_fma_f32 v0, s0, v0, s1
	v_fma_f32 v0, 0x43800000, v0, -0.5
	v_cmp_gt_f32_e32 vcc, 0x437f0000, v0
	v_cndmask_b32_e32 v2, 0x437f0000, v0, vcc
	v_cmp_lt_f32_e32 vcc, 0, v0
	v_cndmask_b32_e32 v0, 0, v2, vcc
	v_cvt_i32_f32_e32 v2, v0
	v_min_i32_e32 v2, 0xfe, v2
	v_add_nc_u32_e32 v3, 1, v2
	s_clause 0x1
	image_load v[4:7], v2, s[32:39] dmask:0xf dim:SQ_RSRC_IMG_1D unorm
	image_load v[8:11], v3, s[32:39] dmask:0xf dim:SQ_RSRC_IMG_1D unorm
	v_cmp_lt_f32_e32 vcc, 0, v12
	v_cndmask_b32_e32 v3, 0, v12, vcc
	v_cmp_gt_f32_e32 vcc, 1.0, v12
	v_cndmask_b32_e32 v3, 1.0, v3, vcc
	v_mul_f32_e32 v3, s19, v3
	v_cvt_f32_i32_e32 v2, v2
	v_sub_f32_e32 v0, v0, v2
	s_waitcnt vmcnt(0)
	v_sub_f32_e32 v2, v8, v4
	v_sub_f32_e32 v8, v9, v5
	v_sub_f32_e32 v9, v10, v6
	v_sub_f32_e32 v34, v11, v7
	v_fmac_f32_e32 v4, v2, v0
	v_fmac_f32_e32 v5, v8, v0
	v_fmac_f32_e32 v6, v9, v0
	v_fmac_f32_e32 v7, v34, v0
	s_mov_b64 s[0:1], exec
	v_cmpx_lt_f32_e32 0, v7
	s_cbranch_execz BB123
BB106:
	s_mov_b64 s[12:13], exec
	v_cmpx_lt_f32_e32 0, v3
	s_cbranch_execz BB115
BB107:
	s_mov_b64 s[14:15], exec
	v_cmpx_nle_f32_e32 1.0, v7
	s_cbranch_execz BB110
BB108:
	v_sub_f32_e32 v0, 1.0, v7
	v_add_nc_u32_e32 v2, 0xc0cafb0d, v0
	v_ashrrev_i32_e32 v34, 23, v2
	v_and_b32_e32 v2, 0xff800000, v2
	v_sub_nc_u32_e32 v0, v0, v2
	v_add_f32_e32 v2, -1.0, v0
	v_cmp_eq_i32_e32 vcc, 0, v34
	v_cndmask_b32_e64 v2, v2, -v7, vcc
	v_add_f32_e32 v0, 1.0, v0
	v_rcp_f32_e32 v0, v0
	v_mul_f32_e32 v0, v2, v0
	v_mul_f32_e32 v2, v0, v0
	s_mov_b32 s16, 0x3ea4258a
	v_fmaak_f32 v35, s16, v2, 0x3ed30bb1
	v_fmaak_f32 v35, v2, v35, 0x3f13bb63
	v_fmaak_f32 v35, v2, v35, 0x3f76384f
	v_fmaak_f32 v2, v2, v35, 0x4038aa3b
	v_cvt_f32_i32_e32 v34, v34
	v_fmac_f32_e32 v34, v0, v2
	v_mul_f32_e32 v0, v3, v34
	v_cmp_lt_f32_e32 vcc, 0xc2fc0000, v0
	v_cndmask_b32_e32 v0, 0xc2fc0000, v0, vcc
	v_add_f32_e32 v2, 0.5, v0
	v_floor_f32_e32 v2, v2
	v_sub_f32_e32 v0, v0, v2
	s_mov_b32 s16, 0x377fe5d9
	v_fmaak_f32 v3, s16, v0, 0x39218489
	v_fmaak_f32 v3, v0, v3, 0x3aaec3ff
	v_fmaak_f32 v3, v0, v3, 0x3c1d955b
	v_fmaak_f32 v3, v0, v3, 0x3d635847
	v_fmaak_f32 v3, v0, v3, 0x3e75fdf0
	v_fmaak_f32 v3, v0, v3, 0x3f317218
	v_mul_f32_e32 v0, v0, v3
	v_cvt_i32_f32_e32 v2, v2
	v_lshl_add_u32 v2, v2, 23, 1.0
	v_sub_f32_e32 v3, 1.0, v2
	v_fma_f32 v0, v2, -v0, v3
BB110:
	s_andn2_b64 exec, s[14:15], exec
BB111:
	v_mov_b32_e32 v0, 1.0
BB113:
	s_mov_b64 exec, s[14:15]
BB115:
	s_andn2_b64 exec, s[12:13], exec
BB116:
	v_mov_b32_e32 v0, 0
BB118:
	s_mov_b64 exec, s[12:13]
	v_mul_f32_e32 v0, v30, v0
	v_fmac_f32_e32 v31, v4, v0
	v_fmac_f32_e32 v32, v5, v0
	v_fmac_f32_e32 v33, v6, v0
	v_sub_f32_e32 v30, v30, v0
BB123:
BB128:
	s_mov_b64 exec, s[4:5]
	s_buffer_load_dwordx4 s[8:11], s[8:11], 0x70
	v_sub_f32_e32 v0, 1.0, v30
	v_lshlrev_b32_e32 v34, 4, v1
	s_waitcnt lgkmcnt(0)
	s_load_dwordx4 s[0:3], s[2:3], 0xf0
	v_fmac_f32_e32 v31, s8, v30
	v_fmac_f32_e32 v32, s9, v30
	v_fmac_f32_e32 v33, s10, v30
	v_fmac_f32_e32 v0, s11, v30
	v_swap_b32 v0, v34
	s_waitcnt lgkmcnt(0)
	buffer_store_dwordx4 v[31:34], v0, s[0:3], 0 offen glc
BB130:
	s_endpgm
