begin_version
3
end_version
begin_metric
0
end_metric
21
begin_variable
var0
-1
200
Atom loc_rob1_r0()
Atom loc_rob1_r1()
Atom loc_rob1_r10()
Atom loc_rob1_r100()
Atom loc_rob1_r101()
Atom loc_rob1_r102()
Atom loc_rob1_r103()
Atom loc_rob1_r104()
Atom loc_rob1_r105()
Atom loc_rob1_r106()
Atom loc_rob1_r107()
Atom loc_rob1_r108()
Atom loc_rob1_r109()
Atom loc_rob1_r11()
Atom loc_rob1_r110()
Atom loc_rob1_r111()
Atom loc_rob1_r112()
Atom loc_rob1_r113()
Atom loc_rob1_r114()
Atom loc_rob1_r115()
Atom loc_rob1_r116()
Atom loc_rob1_r117()
Atom loc_rob1_r118()
Atom loc_rob1_r119()
Atom loc_rob1_r12()
Atom loc_rob1_r120()
Atom loc_rob1_r121()
Atom loc_rob1_r122()
Atom loc_rob1_r123()
Atom loc_rob1_r124()
Atom loc_rob1_r125()
Atom loc_rob1_r126()
Atom loc_rob1_r127()
Atom loc_rob1_r128()
Atom loc_rob1_r129()
Atom loc_rob1_r13()
Atom loc_rob1_r130()
Atom loc_rob1_r131()
Atom loc_rob1_r132()
Atom loc_rob1_r133()
Atom loc_rob1_r134()
Atom loc_rob1_r135()
Atom loc_rob1_r136()
Atom loc_rob1_r137()
Atom loc_rob1_r138()
Atom loc_rob1_r139()
Atom loc_rob1_r14()
Atom loc_rob1_r140()
Atom loc_rob1_r141()
Atom loc_rob1_r142()
Atom loc_rob1_r143()
Atom loc_rob1_r144()
Atom loc_rob1_r145()
Atom loc_rob1_r146()
Atom loc_rob1_r147()
Atom loc_rob1_r148()
Atom loc_rob1_r149()
Atom loc_rob1_r15()
Atom loc_rob1_r150()
Atom loc_rob1_r151()
Atom loc_rob1_r152()
Atom loc_rob1_r153()
Atom loc_rob1_r154()
Atom loc_rob1_r155()
Atom loc_rob1_r156()
Atom loc_rob1_r157()
Atom loc_rob1_r158()
Atom loc_rob1_r159()
Atom loc_rob1_r16()
Atom loc_rob1_r160()
Atom loc_rob1_r161()
Atom loc_rob1_r162()
Atom loc_rob1_r163()
Atom loc_rob1_r164()
Atom loc_rob1_r165()
Atom loc_rob1_r166()
Atom loc_rob1_r167()
Atom loc_rob1_r168()
Atom loc_rob1_r169()
Atom loc_rob1_r17()
Atom loc_rob1_r170()
Atom loc_rob1_r171()
Atom loc_rob1_r172()
Atom loc_rob1_r173()
Atom loc_rob1_r174()
Atom loc_rob1_r175()
Atom loc_rob1_r176()
Atom loc_rob1_r177()
Atom loc_rob1_r178()
Atom loc_rob1_r179()
Atom loc_rob1_r18()
Atom loc_rob1_r180()
Atom loc_rob1_r181()
Atom loc_rob1_r182()
Atom loc_rob1_r183()
Atom loc_rob1_r184()
Atom loc_rob1_r185()
Atom loc_rob1_r186()
Atom loc_rob1_r187()
Atom loc_rob1_r188()
Atom loc_rob1_r189()
Atom loc_rob1_r19()
Atom loc_rob1_r190()
Atom loc_rob1_r191()
Atom loc_rob1_r192()
Atom loc_rob1_r193()
Atom loc_rob1_r194()
Atom loc_rob1_r195()
Atom loc_rob1_r196()
Atom loc_rob1_r197()
Atom loc_rob1_r198()
Atom loc_rob1_r199()
Atom loc_rob1_r2()
Atom loc_rob1_r20()
Atom loc_rob1_r21()
Atom loc_rob1_r22()
Atom loc_rob1_r23()
Atom loc_rob1_r24()
Atom loc_rob1_r25()
Atom loc_rob1_r26()
Atom loc_rob1_r27()
Atom loc_rob1_r28()
Atom loc_rob1_r29()
Atom loc_rob1_r3()
Atom loc_rob1_r30()
Atom loc_rob1_r31()
Atom loc_rob1_r32()
Atom loc_rob1_r33()
Atom loc_rob1_r34()
Atom loc_rob1_r35()
Atom loc_rob1_r36()
Atom loc_rob1_r37()
Atom loc_rob1_r38()
Atom loc_rob1_r39()
Atom loc_rob1_r4()
Atom loc_rob1_r40()
Atom loc_rob1_r41()
Atom loc_rob1_r42()
Atom loc_rob1_r43()
Atom loc_rob1_r44()
Atom loc_rob1_r45()
Atom loc_rob1_r46()
Atom loc_rob1_r47()
Atom loc_rob1_r48()
Atom loc_rob1_r49()
Atom loc_rob1_r5()
Atom loc_rob1_r50()
Atom loc_rob1_r51()
Atom loc_rob1_r52()
Atom loc_rob1_r53()
Atom loc_rob1_r54()
Atom loc_rob1_r55()
Atom loc_rob1_r56()
Atom loc_rob1_r57()
Atom loc_rob1_r58()
Atom loc_rob1_r59()
Atom loc_rob1_r6()
Atom loc_rob1_r60()
Atom loc_rob1_r61()
Atom loc_rob1_r62()
Atom loc_rob1_r63()
Atom loc_rob1_r64()
Atom loc_rob1_r65()
Atom loc_rob1_r66()
Atom loc_rob1_r67()
Atom loc_rob1_r68()
Atom loc_rob1_r69()
Atom loc_rob1_r7()
Atom loc_rob1_r70()
Atom loc_rob1_r71()
Atom loc_rob1_r72()
Atom loc_rob1_r73()
Atom loc_rob1_r74()
Atom loc_rob1_r75()
Atom loc_rob1_r76()
Atom loc_rob1_r77()
Atom loc_rob1_r78()
Atom loc_rob1_r79()
Atom loc_rob1_r8()
Atom loc_rob1_r80()
Atom loc_rob1_r81()
Atom loc_rob1_r82()
Atom loc_rob1_r83()
Atom loc_rob1_r84()
Atom loc_rob1_r85()
Atom loc_rob1_r86()
Atom loc_rob1_r87()
Atom loc_rob1_r88()
Atom loc_rob1_r89()
Atom loc_rob1_r9()
Atom loc_rob1_r90()
Atom loc_rob1_r91()
Atom loc_rob1_r92()
Atom loc_rob1_r93()
Atom loc_rob1_r94()
Atom loc_rob1_r95()
Atom loc_rob1_r96()
Atom loc_rob1_r97()
Atom loc_rob1_r98()
Atom loc_rob1_r99()
end_variable
begin_variable
var20
-1
2
Atom message_status_m0_p24_delivered()
NegatedAtom message_status_m0_p24_delivered()
end_variable
begin_variable
var19
-1
2
Atom message_status_m10_p6_delivered()
NegatedAtom message_status_m10_p6_delivered()
end_variable
begin_variable
var18
-1
2
Atom message_status_m11_p28_delivered()
NegatedAtom message_status_m11_p28_delivered()
end_variable
begin_variable
var17
-1
2
Atom message_status_m12_p45_delivered()
NegatedAtom message_status_m12_p45_delivered()
end_variable
begin_variable
var16
-1
2
Atom message_status_m13_p32_delivered()
NegatedAtom message_status_m13_p32_delivered()
end_variable
begin_variable
var15
-1
2
Atom message_status_m14_p33_delivered()
NegatedAtom message_status_m14_p33_delivered()
end_variable
begin_variable
var14
-1
2
Atom message_status_m15_p34_delivered()
NegatedAtom message_status_m15_p34_delivered()
end_variable
begin_variable
var13
-1
2
Atom message_status_m16_p1_delivered()
NegatedAtom message_status_m16_p1_delivered()
end_variable
begin_variable
var12
-1
2
Atom message_status_m17_p31_delivered()
NegatedAtom message_status_m17_p31_delivered()
end_variable
begin_variable
var11
-1
2
Atom message_status_m18_p10_delivered()
NegatedAtom message_status_m18_p10_delivered()
end_variable
begin_variable
var10
-1
2
Atom message_status_m19_p11_delivered()
NegatedAtom message_status_m19_p11_delivered()
end_variable
begin_variable
var9
-1
2
Atom message_status_m1_p8_delivered()
NegatedAtom message_status_m1_p8_delivered()
end_variable
begin_variable
var8
-1
2
Atom message_status_m2_p13_delivered()
NegatedAtom message_status_m2_p13_delivered()
end_variable
begin_variable
var7
-1
2
Atom message_status_m3_p18_delivered()
NegatedAtom message_status_m3_p18_delivered()
end_variable
begin_variable
var6
-1
2
Atom message_status_m4_p32_delivered()
NegatedAtom message_status_m4_p32_delivered()
end_variable
begin_variable
var5
-1
2
Atom message_status_m5_p23_delivered()
NegatedAtom message_status_m5_p23_delivered()
end_variable
begin_variable
var4
-1
2
Atom message_status_m6_p1_delivered()
NegatedAtom message_status_m6_p1_delivered()
end_variable
begin_variable
var3
-1
2
Atom message_status_m7_p3_delivered()
NegatedAtom message_status_m7_p3_delivered()
end_variable
begin_variable
var2
-1
2
Atom message_status_m8_p48_delivered()
NegatedAtom message_status_m8_p48_delivered()
end_variable
begin_variable
var1
-1
2
Atom message_status_m9_p10_delivered()
NegatedAtom message_status_m9_p10_delivered()
end_variable
0
begin_state
137
1
1
1
1
1
1
1
1
1
1
1
1
1
1
1
1
1
1
1
1
end_state
begin_goal
20
1 0
2 0
3 0
4 0
5 0
6 0
7 0
8 0
9 0
10 0
11 0
12 0
13 0
14 0
15 0
16 0
17 0
18 0
19 0
20 0
end_goal
436
begin_operator
deliver_rob1_m0_p24 
1
0 136
1
0 1 -1 0
1
end_operator
begin_operator
deliver_rob1_m10_p6 
1
0 134
1
0 2 -1 0
1
end_operator
begin_operator
deliver_rob1_m11_p28 
1
0 60
1
0 3 -1 0
1
end_operator
begin_operator
deliver_rob1_m12_p45 
1
0 24
1
0 4 -1 0
1
end_operator
begin_operator
deliver_rob1_m13_p32 
1
0 72
1
0 5 -1 0
1
end_operator
begin_operator
deliver_rob1_m14_p33 
1
0 26
1
0 6 -1 0
1
end_operator
begin_operator
deliver_rob1_m15_p34 
1
0 28
1
0 7 -1 0
1
end_operator
begin_operator
deliver_rob1_m16_p1 
1
0 103
1
0 8 -1 0
1
end_operator
begin_operator
deliver_rob1_m17_p31 
1
0 172
1
0 9 -1 0
1
end_operator
begin_operator
deliver_rob1_m18_p10 
1
0 19
1
0 10 -1 0
1
end_operator
begin_operator
deliver_rob1_m19_p11 
1
0 169
1
0 11 -1 0
1
end_operator
begin_operator
deliver_rob1_m1_p8 
1
0 110
1
0 12 -1 0
1
end_operator
begin_operator
deliver_rob1_m2_p13 
1
0 101
1
0 13 -1 0
1
end_operator
begin_operator
deliver_rob1_m3_p18 
1
0 153
1
0 14 -1 0
1
end_operator
begin_operator
deliver_rob1_m4_p32 
1
0 72
1
0 15 -1 0
1
end_operator
begin_operator
deliver_rob1_m5_p23 
1
0 193
1
0 16 -1 0
1
end_operator
begin_operator
deliver_rob1_m6_p1 
1
0 103
1
0 17 -1 0
1
end_operator
begin_operator
deliver_rob1_m7_p3 
1
0 11
1
0 18 -1 0
1
end_operator
begin_operator
deliver_rob1_m8_p48 
1
0 182
1
0 19 -1 0
1
end_operator
begin_operator
deliver_rob1_m9_p10 
1
0 19
1
0 20 -1 0
1
end_operator
begin_operator
move_rob1_r0 
0
1
0 0 1 0
1
end_operator
begin_operator
move_rob1_r0_10 
0
1
0 0 101 0
1
end_operator
begin_operator
move_rob1_r0_11 
0
1
0 0 112 0
1
end_operator
begin_operator
move_rob1_r0_12 
0
1
0 0 167 0
1
end_operator
begin_operator
move_rob1_r0_2 
0
1
0 0 27 0
1
end_operator
begin_operator
move_rob1_r0_3 
0
1
0 0 33 0
1
end_operator
begin_operator
move_rob1_r0_4 
0
1
0 0 60 0
1
end_operator
begin_operator
move_rob1_r0_5 
0
1
0 0 66 0
1
end_operator
begin_operator
move_rob1_r0_6 
0
1
0 0 79 0
1
end_operator
begin_operator
move_rob1_r0_7 
0
1
0 0 90 0
1
end_operator
begin_operator
move_rob1_r0_8 
0
1
0 0 98 0
1
end_operator
begin_operator
move_rob1_r0_9 
0
1
0 0 99 0
1
end_operator
begin_operator
move_rob1_r1 
0
1
0 0 0 1
1
end_operator
begin_operator
move_rob1_r10 
0
1
0 0 1 2
1
end_operator
begin_operator
move_rob1_r100 
0
1
0 0 90 3
1
end_operator
begin_operator
move_rob1_r101 
0
1
0 0 117 4
1
end_operator
begin_operator
move_rob1_r102 
0
1
0 0 57 5
1
end_operator
begin_operator
move_rob1_r103 
0
1
0 0 134 6
1
end_operator
begin_operator
move_rob1_r104 
0
1
0 0 145 7
1
end_operator
begin_operator
move_rob1_r105 
0
1
0 0 127 8
1
end_operator
begin_operator
move_rob1_r106 
0
1
0 0 35 9
1
end_operator
begin_operator
move_rob1_r107 
0
1
0 0 126 10
1
end_operator
begin_operator
move_rob1_r108 
0
1
0 0 134 11
1
end_operator
begin_operator
move_rob1_r109 
0
1
0 0 131 12
1
end_operator
begin_operator
move_rob1_r10_2 
0
1
0 0 53 2
1
end_operator
begin_operator
move_rob1_r10_3 
0
1
0 0 84 2
1
end_operator
begin_operator
move_rob1_r10_4 
0
1
0 0 91 2
1
end_operator
begin_operator
move_rob1_r10_5 
0
1
0 0 127 2
1
end_operator
begin_operator
move_rob1_r10_6 
0
1
0 0 139 2
1
end_operator
begin_operator
move_rob1_r11 
0
1
0 0 34 13
1
end_operator
begin_operator
move_rob1_r110 
0
1
0 0 178 14
1
end_operator
begin_operator
move_rob1_r111 
0
1
0 0 121 15
1
end_operator
begin_operator
move_rob1_r112 
0
1
0 0 126 16
1
end_operator
begin_operator
move_rob1_r113 
0
1
0 0 189 17
1
end_operator
begin_operator
move_rob1_r114 
0
1
0 0 167 18
1
end_operator
begin_operator
move_rob1_r115 
0
1
0 0 114 19
1
end_operator
begin_operator
move_rob1_r116 
0
1
0 0 124 20
1
end_operator
begin_operator
move_rob1_r117 
0
1
0 0 117 21
1
end_operator
begin_operator
move_rob1_r118 
0
1
0 0 1 22
1
end_operator
begin_operator
move_rob1_r119 
0
1
0 0 114 23
1
end_operator
begin_operator
move_rob1_r11_2 
0
1
0 0 63 13
1
end_operator
begin_operator
move_rob1_r11_3 
0
1
0 0 120 13
1
end_operator
begin_operator
move_rob1_r11_4 
0
1
0 0 123 13
1
end_operator
begin_operator
move_rob1_r11_5 
0
1
0 0 138 13
1
end_operator
begin_operator
move_rob1_r11_6 
0
1
0 0 166 13
1
end_operator
begin_operator
move_rob1_r12 
0
1
0 0 1 24
1
end_operator
begin_operator
move_rob1_r120 
0
1
0 0 121 25
1
end_operator
begin_operator
move_rob1_r121 
0
1
0 0 79 26
1
end_operator
begin_operator
move_rob1_r122 
0
1
0 0 0 27
1
end_operator
begin_operator
move_rob1_r123 
0
1
0 0 156 28
1
end_operator
begin_operator
move_rob1_r124 
0
1
0 0 128 29
1
end_operator
begin_operator
move_rob1_r125 
0
1
0 0 112 30
1
end_operator
begin_operator
move_rob1_r126 
0
1
0 0 122 31
1
end_operator
begin_operator
move_rob1_r127 
0
1
0 0 134 32
1
end_operator
begin_operator
move_rob1_r128 
0
1
0 0 0 33
1
end_operator
begin_operator
move_rob1_r129 
0
1
0 0 13 34
1
end_operator
begin_operator
move_rob1_r12_2 
0
1
0 0 39 24
1
end_operator
begin_operator
move_rob1_r12_3 
0
1
0 0 87 24
1
end_operator
begin_operator
move_rob1_r12_4 
0
1
0 0 159 24
1
end_operator
begin_operator
move_rob1_r12_5 
0
1
0 0 171 24
1
end_operator
begin_operator
move_rob1_r13 
0
1
0 0 1 35
1
end_operator
begin_operator
move_rob1_r130 
0
1
0 0 127 36
1
end_operator
begin_operator
move_rob1_r131 
0
1
0 0 134 37
1
end_operator
begin_operator
move_rob1_r132 
0
1
0 0 121 38
1
end_operator
begin_operator
move_rob1_r133 
0
1
0 0 24 39
1
end_operator
begin_operator
move_rob1_r134 
0
1
0 0 1 40
1
end_operator
begin_operator
move_rob1_r135 
0
1
0 0 134 41
1
end_operator
begin_operator
move_rob1_r136 
0
1
0 0 167 42
1
end_operator
begin_operator
move_rob1_r137 
0
1
0 0 129 43
1
end_operator
begin_operator
move_rob1_r138 
0
1
0 0 79 44
1
end_operator
begin_operator
move_rob1_r139 
0
1
0 0 114 45
1
end_operator
begin_operator
move_rob1_r13_2 
0
1
0 0 9 35
1
end_operator
begin_operator
move_rob1_r13_3 
0
1
0 0 96 35
1
end_operator
begin_operator
move_rob1_r13_4 
0
1
0 0 113 35
1
end_operator
begin_operator
move_rob1_r13_5 
0
1
0 0 114 35
1
end_operator
begin_operator
move_rob1_r13_6 
0
1
0 0 124 35
1
end_operator
begin_operator
move_rob1_r13_7 
0
1
0 0 170 35
1
end_operator
begin_operator
move_rob1_r13_8 
0
1
0 0 175 35
1
end_operator
begin_operator
move_rob1_r14 
0
1
0 0 78 46
1
end_operator
begin_operator
move_rob1_r140 
0
1
0 0 124 47
1
end_operator
begin_operator
move_rob1_r141 
0
1
0 0 113 48
1
end_operator
begin_operator
move_rob1_r142 
0
1
0 0 122 49
1
end_operator
begin_operator
move_rob1_r143 
0
1
0 0 119 50
1
end_operator
begin_operator
move_rob1_r144 
0
1
0 0 116 51
1
end_operator
begin_operator
move_rob1_r145 
0
1
0 0 156 52
1
end_operator
begin_operator
move_rob1_r146 
0
1
0 0 2 53
1
end_operator
begin_operator
move_rob1_r147 
0
1
0 0 130 54
1
end_operator
begin_operator
move_rob1_r148 
0
1
0 0 167 55
1
end_operator
begin_operator
move_rob1_r149 
0
1
0 0 114 56
1
end_operator
begin_operator
move_rob1_r14_2 
0
1
0 0 104 46
1
end_operator
begin_operator
move_rob1_r14_3 
0
1
0 0 112 46
1
end_operator
begin_operator
move_rob1_r14_4 
0
1
0 0 121 46
1
end_operator
begin_operator
move_rob1_r14_5 
0
1
0 0 149 46
1
end_operator
begin_operator
move_rob1_r14_6 
0
1
0 0 199 46
1
end_operator
begin_operator
move_rob1_r15 
0
1
0 0 1 57
1
end_operator
begin_operator
move_rob1_r150 
0
1
0 0 120 58
1
end_operator
begin_operator
move_rob1_r151 
0
1
0 0 127 59
1
end_operator
begin_operator
move_rob1_r152 
0
1
0 0 0 60
1
end_operator
begin_operator
move_rob1_r153 
0
1
0 0 113 61
1
end_operator
begin_operator
move_rob1_r154 
0
1
0 0 118 62
1
end_operator
begin_operator
move_rob1_r155 
0
1
0 0 13 63
1
end_operator
begin_operator
move_rob1_r156 
0
1
0 0 79 64
1
end_operator
begin_operator
move_rob1_r157 
0
1
0 0 122 65
1
end_operator
begin_operator
move_rob1_r158 
0
1
0 0 0 66
1
end_operator
begin_operator
move_rob1_r159 
0
1
0 0 145 67
1
end_operator
begin_operator
move_rob1_r15_2 
0
1
0 0 5 57
1
end_operator
begin_operator
move_rob1_r15_3 
0
1
0 0 68 57
1
end_operator
begin_operator
move_rob1_r15_4 
0
1
0 0 81 57
1
end_operator
begin_operator
move_rob1_r15_5 
0
1
0 0 109 57
1
end_operator
begin_operator
move_rob1_r16 
0
1
0 0 57 68
1
end_operator
begin_operator
move_rob1_r160 
0
1
0 0 167 69
1
end_operator
begin_operator
move_rob1_r161 
0
1
0 0 1 70
1
end_operator
begin_operator
move_rob1_r162 
0
1
0 0 123 71
1
end_operator
begin_operator
move_rob1_r163 
0
1
0 0 68 72
1
end_operator
begin_operator
move_rob1_r164 
0
1
0 0 115 73
1
end_operator
begin_operator
move_rob1_r165 
0
1
0 0 129 74
1
end_operator
begin_operator
move_rob1_r166 
0
1
0 0 133 75
1
end_operator
begin_operator
move_rob1_r167 
0
1
0 0 129 76
1
end_operator
begin_operator
move_rob1_r168 
0
1
0 0 121 77
1
end_operator
begin_operator
move_rob1_r169 
0
1
0 0 46 78
1
end_operator
begin_operator
move_rob1_r16_2 
0
1
0 0 72 68
1
end_operator
begin_operator
move_rob1_r16_3 
0
1
0 0 97 68
1
end_operator
begin_operator
move_rob1_r16_4 
0
1
0 0 130 68
1
end_operator
begin_operator
move_rob1_r16_5 
0
1
0 0 140 68
1
end_operator
begin_operator
move_rob1_r16_6 
0
1
0 0 198 68
1
end_operator
begin_operator
move_rob1_r17 
0
1
0 0 0 79
1
end_operator
begin_operator
move_rob1_r170 
0
1
0 0 117 80
1
end_operator
begin_operator
move_rob1_r171 
0
1
0 0 57 81
1
end_operator
begin_operator
move_rob1_r172 
0
1
0 0 116 82
1
end_operator
begin_operator
move_rob1_r173 
0
1
0 0 131 83
1
end_operator
begin_operator
move_rob1_r174 
0
1
0 0 2 84
1
end_operator
begin_operator
move_rob1_r175 
0
1
0 0 114 85
1
end_operator
begin_operator
move_rob1_r176 
0
1
0 0 130 86
1
end_operator
begin_operator
move_rob1_r177 
0
1
0 0 24 87
1
end_operator
begin_operator
move_rob1_r178 
0
1
0 0 119 88
1
end_operator
begin_operator
move_rob1_r179 
0
1
0 0 120 89
1
end_operator
begin_operator
move_rob1_r17_2 
0
1
0 0 26 79
1
end_operator
begin_operator
move_rob1_r17_3 
0
1
0 0 44 79
1
end_operator
begin_operator
move_rob1_r17_4 
0
1
0 0 64 79
1
end_operator
begin_operator
move_rob1_r17_5 
0
1
0 0 119 79
1
end_operator
begin_operator
move_rob1_r17_6 
0
1
0 0 133 79
1
end_operator
begin_operator
move_rob1_r17_7 
0
1
0 0 157 79
1
end_operator
begin_operator
move_rob1_r18 
0
1
0 0 0 90
1
end_operator
begin_operator
move_rob1_r180 
0
1
0 0 2 91
1
end_operator
begin_operator
move_rob1_r181 
0
1
0 0 129 92
1
end_operator
begin_operator
move_rob1_r182 
0
1
0 0 131 93
1
end_operator
begin_operator
move_rob1_r183 
0
1
0 0 1 94
1
end_operator
begin_operator
move_rob1_r184 
0
1
0 0 101 95
1
end_operator
begin_operator
move_rob1_r185 
0
1
0 0 35 96
1
end_operator
begin_operator
move_rob1_r186 
0
1
0 0 68 97
1
end_operator
begin_operator
move_rob1_r187 
0
1
0 0 0 98
1
end_operator
begin_operator
move_rob1_r188 
0
1
0 0 0 99
1
end_operator
begin_operator
move_rob1_r189 
0
1
0 0 121 100
1
end_operator
begin_operator
move_rob1_r18_2 
0
1
0 0 3 90
1
end_operator
begin_operator
move_rob1_r18_3 
0
1
0 0 189 90
1
end_operator
begin_operator
move_rob1_r19 
0
1
0 0 0 101
1
end_operator
begin_operator
move_rob1_r190 
0
1
0 0 167 102
1
end_operator
begin_operator
move_rob1_r191 
0
1
0 0 145 103
1
end_operator
begin_operator
move_rob1_r192 
0
1
0 0 46 104
1
end_operator
begin_operator
move_rob1_r193 
0
1
0 0 123 105
1
end_operator
begin_operator
move_rob1_r194 
0
1
0 0 128 106
1
end_operator
begin_operator
move_rob1_r195 
0
1
0 0 113 107
1
end_operator
begin_operator
move_rob1_r196 
0
1
0 0 124 108
1
end_operator
begin_operator
move_rob1_r197 
0
1
0 0 57 109
1
end_operator
begin_operator
move_rob1_r198 
0
1
0 0 127 110
1
end_operator
begin_operator
move_rob1_r199 
0
1
0 0 115 111
1
end_operator
begin_operator
move_rob1_r19_2 
0
1
0 0 95 101
1
end_operator
begin_operator
move_rob1_r19_3 
0
1
0 0 135 101
1
end_operator
begin_operator
move_rob1_r19_4 
0
1
0 0 136 101
1
end_operator
begin_operator
move_rob1_r19_5 
0
1
0 0 142 101
1
end_operator
begin_operator
move_rob1_r19_6 
0
1
0 0 151 101
1
end_operator
begin_operator
move_rob1_r19_7 
0
1
0 0 164 101
1
end_operator
begin_operator
move_rob1_r1_10 
0
1
0 0 116 1
1
end_operator
begin_operator
move_rob1_r1_11 
0
1
0 0 123 1
1
end_operator
begin_operator
move_rob1_r1_12 
0
1
0 0 134 1
1
end_operator
begin_operator
move_rob1_r1_13 
0
1
0 0 153 1
1
end_operator
begin_operator
move_rob1_r1_14 
0
1
0 0 184 1
1
end_operator
begin_operator
move_rob1_r1_15 
0
1
0 0 191 1
1
end_operator
begin_operator
move_rob1_r1_2 
0
1
0 0 2 1
1
end_operator
begin_operator
move_rob1_r1_3 
0
1
0 0 22 1
1
end_operator
begin_operator
move_rob1_r1_4 
0
1
0 0 24 1
1
end_operator
begin_operator
move_rob1_r1_5 
0
1
0 0 35 1
1
end_operator
begin_operator
move_rob1_r1_6 
0
1
0 0 40 1
1
end_operator
begin_operator
move_rob1_r1_7 
0
1
0 0 57 1
1
end_operator
begin_operator
move_rob1_r1_8 
0
1
0 0 70 1
1
end_operator
begin_operator
move_rob1_r1_9 
0
1
0 0 94 1
1
end_operator
begin_operator
move_rob1_r2 
0
1
0 0 0 112
1
end_operator
begin_operator
move_rob1_r20 
0
1
0 0 35 113
1
end_operator
begin_operator
move_rob1_r20_2 
0
1
0 0 48 113
1
end_operator
begin_operator
move_rob1_r20_3 
0
1
0 0 61 113
1
end_operator
begin_operator
move_rob1_r20_4 
0
1
0 0 107 113
1
end_operator
begin_operator
move_rob1_r20_5 
0
1
0 0 120 113
1
end_operator
begin_operator
move_rob1_r20_6 
0
1
0 0 147 113
1
end_operator
begin_operator
move_rob1_r21 
0
1
0 0 19 114
1
end_operator
begin_operator
move_rob1_r21_2 
0
1
0 0 23 114
1
end_operator
begin_operator
move_rob1_r21_3 
0
1
0 0 35 114
1
end_operator
begin_operator
move_rob1_r21_4 
0
1
0 0 45 114
1
end_operator
begin_operator
move_rob1_r21_5 
0
1
0 0 56 114
1
end_operator
begin_operator
move_rob1_r21_6 
0
1
0 0 85 114
1
end_operator
begin_operator
move_rob1_r21_7 
0
1
0 0 118 114
1
end_operator
begin_operator
move_rob1_r21_8 
0
1
0 0 176 114
1
end_operator
begin_operator
move_rob1_r22 
0
1
0 0 73 115
1
end_operator
begin_operator
move_rob1_r22_2 
0
1
0 0 111 115
1
end_operator
begin_operator
move_rob1_r22_3 
0
1
0 0 123 115
1
end_operator
begin_operator
move_rob1_r22_4 
0
1
0 0 126 115
1
end_operator
begin_operator
move_rob1_r22_5 
0
1
0 0 148 115
1
end_operator
begin_operator
move_rob1_r23 
0
1
0 0 1 116
1
end_operator
begin_operator
move_rob1_r23_2 
0
1
0 0 51 116
1
end_operator
begin_operator
move_rob1_r23_3 
0
1
0 0 82 116
1
end_operator
begin_operator
move_rob1_r24 
0
1
0 0 4 117
1
end_operator
begin_operator
move_rob1_r24_2 
0
1
0 0 21 117
1
end_operator
begin_operator
move_rob1_r24_3 
0
1
0 0 80 117
1
end_operator
begin_operator
move_rob1_r24_4 
0
1
0 0 123 117
1
end_operator
begin_operator
move_rob1_r24_5 
0
1
0 0 158 117
1
end_operator
begin_operator
move_rob1_r24_6 
0
1
0 0 163 117
1
end_operator
begin_operator
move_rob1_r25 
0
1
0 0 62 118
1
end_operator
begin_operator
move_rob1_r25_2 
0
1
0 0 114 118
1
end_operator
begin_operator
move_rob1_r25_3 
0
1
0 0 122 118
1
end_operator
begin_operator
move_rob1_r25_4 
0
1
0 0 168 118
1
end_operator
begin_operator
move_rob1_r25_5 
0
1
0 0 174 118
1
end_operator
begin_operator
move_rob1_r25_6 
0
1
0 0 196 118
1
end_operator
begin_operator
move_rob1_r26 
0
1
0 0 50 119
1
end_operator
begin_operator
move_rob1_r26_2 
0
1
0 0 79 119
1
end_operator
begin_operator
move_rob1_r26_3 
0
1
0 0 88 119
1
end_operator
begin_operator
move_rob1_r26_4 
0
1
0 0 122 119
1
end_operator
begin_operator
move_rob1_r26_5 
0
1
0 0 173 119
1
end_operator
begin_operator
move_rob1_r26_6 
0
1
0 0 195 119
1
end_operator
begin_operator
move_rob1_r27 
0
1
0 0 13 120
1
end_operator
begin_operator
move_rob1_r27_2 
0
1
0 0 58 120
1
end_operator
begin_operator
move_rob1_r27_3 
0
1
0 0 89 120
1
end_operator
begin_operator
move_rob1_r27_4 
0
1
0 0 113 120
1
end_operator
begin_operator
move_rob1_r27_5 
0
1
0 0 130 120
1
end_operator
begin_operator
move_rob1_r27_6 
0
1
0 0 192 120
1
end_operator
begin_operator
move_rob1_r28 
0
1
0 0 15 121
1
end_operator
begin_operator
move_rob1_r28_2 
0
1
0 0 25 121
1
end_operator
begin_operator
move_rob1_r28_3 
0
1
0 0 38 121
1
end_operator
begin_operator
move_rob1_r28_4 
0
1
0 0 46 121
1
end_operator
begin_operator
move_rob1_r28_5 
0
1
0 0 77 121
1
end_operator
begin_operator
move_rob1_r28_6 
0
1
0 0 100 121
1
end_operator
begin_operator
move_rob1_r28_7 
0
1
0 0 150 121
1
end_operator
begin_operator
move_rob1_r28_8 
0
1
0 0 172 121
1
end_operator
begin_operator
move_rob1_r29 
0
1
0 0 31 122
1
end_operator
begin_operator
move_rob1_r29_2 
0
1
0 0 49 122
1
end_operator
begin_operator
move_rob1_r29_3 
0
1
0 0 65 122
1
end_operator
begin_operator
move_rob1_r29_4 
0
1
0 0 118 122
1
end_operator
begin_operator
move_rob1_r29_5 
0
1
0 0 119 122
1
end_operator
begin_operator
move_rob1_r29_6 
0
1
0 0 141 122
1
end_operator
begin_operator
move_rob1_r29_7 
0
1
0 0 169 122
1
end_operator
begin_operator
move_rob1_r29_8 
0
1
0 0 189 122
1
end_operator
begin_operator
move_rob1_r2_2 
0
1
0 0 30 112
1
end_operator
begin_operator
move_rob1_r2_3 
0
1
0 0 46 112
1
end_operator
begin_operator
move_rob1_r2_4 
0
1
0 0 125 112
1
end_operator
begin_operator
move_rob1_r2_5 
0
1
0 0 129 112
1
end_operator
begin_operator
move_rob1_r2_6 
0
1
0 0 186 112
1
end_operator
begin_operator
move_rob1_r2_7 
0
1
0 0 189 112
1
end_operator
begin_operator
move_rob1_r3 
0
1
0 0 1 123
1
end_operator
begin_operator
move_rob1_r30 
0
1
0 0 20 124
1
end_operator
begin_operator
move_rob1_r30_2 
0
1
0 0 35 124
1
end_operator
begin_operator
move_rob1_r30_3 
0
1
0 0 47 124
1
end_operator
begin_operator
move_rob1_r30_4 
0
1
0 0 108 124
1
end_operator
begin_operator
move_rob1_r30_5 
0
1
0 0 128 124
1
end_operator
begin_operator
move_rob1_r30_6 
0
1
0 0 197 124
1
end_operator
begin_operator
move_rob1_r31 
0
1
0 0 112 125
1
end_operator
begin_operator
move_rob1_r31_2 
0
1
0 0 132 125
1
end_operator
begin_operator
move_rob1_r32 
0
1
0 0 10 126
1
end_operator
begin_operator
move_rob1_r32_2 
0
1
0 0 16 126
1
end_operator
begin_operator
move_rob1_r32_3 
0
1
0 0 115 126
1
end_operator
begin_operator
move_rob1_r32_4 
0
1
0 0 187 126
1
end_operator
begin_operator
move_rob1_r32_5 
0
1
0 0 189 126
1
end_operator
begin_operator
move_rob1_r33 
0
1
0 0 2 127
1
end_operator
begin_operator
move_rob1_r33_2 
0
1
0 0 8 127
1
end_operator
begin_operator
move_rob1_r33_3 
0
1
0 0 36 127
1
end_operator
begin_operator
move_rob1_r33_4 
0
1
0 0 59 127
1
end_operator
begin_operator
move_rob1_r33_5 
0
1
0 0 110 127
1
end_operator
begin_operator
move_rob1_r33_6 
0
1
0 0 128 127
1
end_operator
begin_operator
move_rob1_r33_7 
0
1
0 0 154 127
1
end_operator
begin_operator
move_rob1_r33_8 
0
1
0 0 185 127
1
end_operator
begin_operator
move_rob1_r34 
0
1
0 0 29 128
1
end_operator
begin_operator
move_rob1_r34_2 
0
1
0 0 106 128
1
end_operator
begin_operator
move_rob1_r34_3 
0
1
0 0 124 128
1
end_operator
begin_operator
move_rob1_r34_4 
0
1
0 0 127 128
1
end_operator
begin_operator
move_rob1_r35 
0
1
0 0 43 129
1
end_operator
begin_operator
move_rob1_r35_2 
0
1
0 0 74 129
1
end_operator
begin_operator
move_rob1_r35_3 
0
1
0 0 76 129
1
end_operator
begin_operator
move_rob1_r35_4 
0
1
0 0 92 129
1
end_operator
begin_operator
move_rob1_r35_5 
0
1
0 0 112 129
1
end_operator
begin_operator
move_rob1_r35_6 
0
1
0 0 188 129
1
end_operator
begin_operator
move_rob1_r36 
0
1
0 0 54 130
1
end_operator
begin_operator
move_rob1_r36_2 
0
1
0 0 68 130
1
end_operator
begin_operator
move_rob1_r36_3 
0
1
0 0 86 130
1
end_operator
begin_operator
move_rob1_r36_4 
0
1
0 0 120 130
1
end_operator
begin_operator
move_rob1_r36_5 
0
1
0 0 123 130
1
end_operator
begin_operator
move_rob1_r36_6 
0
1
0 0 137 130
1
end_operator
begin_operator
move_rob1_r36_7 
0
1
0 0 179 130
1
end_operator
begin_operator
move_rob1_r36_8 
0
1
0 0 180 130
1
end_operator
begin_operator
move_rob1_r36_9 
0
1
0 0 190 130
1
end_operator
begin_operator
move_rob1_r37 
0
1
0 0 12 131
1
end_operator
begin_operator
move_rob1_r37_2 
0
1
0 0 83 131
1
end_operator
begin_operator
move_rob1_r37_3 
0
1
0 0 93 131
1
end_operator
begin_operator
move_rob1_r37_4 
0
1
0 0 144 131
1
end_operator
begin_operator
move_rob1_r37_5 
0
1
0 0 145 131
1
end_operator
begin_operator
move_rob1_r38 
0
1
0 0 123 132
1
end_operator
begin_operator
move_rob1_r38_2 
0
1
0 0 125 132
1
end_operator
begin_operator
move_rob1_r38_3 
0
1
0 0 146 132
1
end_operator
begin_operator
move_rob1_r38_4 
0
1
0 0 177 132
1
end_operator
begin_operator
move_rob1_r38_5 
0
1
0 0 181 132
1
end_operator
begin_operator
move_rob1_r38_6 
0
1
0 0 183 132
1
end_operator
begin_operator
move_rob1_r39 
0
1
0 0 75 133
1
end_operator
begin_operator
move_rob1_r39_2 
0
1
0 0 79 133
1
end_operator
begin_operator
move_rob1_r39_3 
0
1
0 0 160 133
1
end_operator
begin_operator
move_rob1_r3_10 
0
1
0 0 165 123
1
end_operator
begin_operator
move_rob1_r3_11 
0
1
0 0 182 123
1
end_operator
begin_operator
move_rob1_r3_2 
0
1
0 0 13 123
1
end_operator
begin_operator
move_rob1_r3_3 
0
1
0 0 71 123
1
end_operator
begin_operator
move_rob1_r3_4 
0
1
0 0 105 123
1
end_operator
begin_operator
move_rob1_r3_5 
0
1
0 0 115 123
1
end_operator
begin_operator
move_rob1_r3_6 
0
1
0 0 117 123
1
end_operator
begin_operator
move_rob1_r3_7 
0
1
0 0 130 123
1
end_operator
begin_operator
move_rob1_r3_8 
0
1
0 0 132 123
1
end_operator
begin_operator
move_rob1_r3_9 
0
1
0 0 145 123
1
end_operator
begin_operator
move_rob1_r4 
0
1
0 0 1 134
1
end_operator
begin_operator
move_rob1_r40 
0
1
0 0 101 135
1
end_operator
begin_operator
move_rob1_r41 
0
1
0 0 101 136
1
end_operator
begin_operator
move_rob1_r42 
0
1
0 0 130 137
1
end_operator
begin_operator
move_rob1_r43 
0
1
0 0 13 138
1
end_operator
begin_operator
move_rob1_r44 
0
1
0 0 2 139
1
end_operator
begin_operator
move_rob1_r45 
0
1
0 0 68 140
1
end_operator
begin_operator
move_rob1_r46 
0
1
0 0 122 141
1
end_operator
begin_operator
move_rob1_r47 
0
1
0 0 101 142
1
end_operator
begin_operator
move_rob1_r48 
0
1
0 0 189 143
1
end_operator
begin_operator
move_rob1_r49 
0
1
0 0 131 144
1
end_operator
begin_operator
move_rob1_r4_2 
0
1
0 0 6 134
1
end_operator
begin_operator
move_rob1_r4_3 
0
1
0 0 11 134
1
end_operator
begin_operator
move_rob1_r4_4 
0
1
0 0 32 134
1
end_operator
begin_operator
move_rob1_r4_5 
0
1
0 0 37 134
1
end_operator
begin_operator
move_rob1_r4_6 
0
1
0 0 41 134
1
end_operator
begin_operator
move_rob1_r4_7 
0
1
0 0 161 134
1
end_operator
begin_operator
move_rob1_r4_8 
0
1
0 0 162 134
1
end_operator
begin_operator
move_rob1_r5 
0
1
0 0 7 145
1
end_operator
begin_operator
move_rob1_r50 
0
1
0 0 132 146
1
end_operator
begin_operator
move_rob1_r51 
0
1
0 0 113 147
1
end_operator
begin_operator
move_rob1_r52 
0
1
0 0 115 148
1
end_operator
begin_operator
move_rob1_r53 
0
1
0 0 46 149
1
end_operator
begin_operator
move_rob1_r54 
0
1
0 0 121 150
1
end_operator
begin_operator
move_rob1_r55 
0
1
0 0 101 151
1
end_operator
begin_operator
move_rob1_r56 
0
1
0 0 178 152
1
end_operator
begin_operator
move_rob1_r57 
0
1
0 0 1 153
1
end_operator
begin_operator
move_rob1_r58 
0
1
0 0 127 154
1
end_operator
begin_operator
move_rob1_r59 
0
1
0 0 178 155
1
end_operator
begin_operator
move_rob1_r5_2 
0
1
0 0 67 145
1
end_operator
begin_operator
move_rob1_r5_3 
0
1
0 0 103 145
1
end_operator
begin_operator
move_rob1_r5_4 
0
1
0 0 123 145
1
end_operator
begin_operator
move_rob1_r5_5 
0
1
0 0 131 145
1
end_operator
begin_operator
move_rob1_r5_6 
0
1
0 0 156 145
1
end_operator
begin_operator
move_rob1_r5_7 
0
1
0 0 178 145
1
end_operator
begin_operator
move_rob1_r5_8 
0
1
0 0 193 145
1
end_operator
begin_operator
move_rob1_r6 
0
1
0 0 28 156
1
end_operator
begin_operator
move_rob1_r60 
0
1
0 0 79 157
1
end_operator
begin_operator
move_rob1_r61 
0
1
0 0 117 158
1
end_operator
begin_operator
move_rob1_r62 
0
1
0 0 24 159
1
end_operator
begin_operator
move_rob1_r63 
0
1
0 0 133 160
1
end_operator
begin_operator
move_rob1_r64 
0
1
0 0 134 161
1
end_operator
begin_operator
move_rob1_r65 
0
1
0 0 134 162
1
end_operator
begin_operator
move_rob1_r66 
0
1
0 0 117 163
1
end_operator
begin_operator
move_rob1_r67 
0
1
0 0 101 164
1
end_operator
begin_operator
move_rob1_r68 
0
1
0 0 123 165
1
end_operator
begin_operator
move_rob1_r69 
0
1
0 0 13 166
1
end_operator
begin_operator
move_rob1_r6_2 
0
1
0 0 52 156
1
end_operator
begin_operator
move_rob1_r6_3 
0
1
0 0 145 156
1
end_operator
begin_operator
move_rob1_r7 
0
1
0 0 0 167
1
end_operator
begin_operator
move_rob1_r70 
0
1
0 0 118 168
1
end_operator
begin_operator
move_rob1_r71 
0
1
0 0 122 169
1
end_operator
begin_operator
move_rob1_r72 
0
1
0 0 35 170
1
end_operator
begin_operator
move_rob1_r73 
0
1
0 0 24 171
1
end_operator
begin_operator
move_rob1_r74 
0
1
0 0 121 172
1
end_operator
begin_operator
move_rob1_r75 
0
1
0 0 119 173
1
end_operator
begin_operator
move_rob1_r76 
0
1
0 0 118 174
1
end_operator
begin_operator
move_rob1_r77 
0
1
0 0 35 175
1
end_operator
begin_operator
move_rob1_r78 
0
1
0 0 114 176
1
end_operator
begin_operator
move_rob1_r79 
0
1
0 0 132 177
1
end_operator
begin_operator
move_rob1_r7_2 
0
1
0 0 18 167
1
end_operator
begin_operator
move_rob1_r7_3 
0
1
0 0 42 167
1
end_operator
begin_operator
move_rob1_r7_4 
0
1
0 0 55 167
1
end_operator
begin_operator
move_rob1_r7_5 
0
1
0 0 69 167
1
end_operator
begin_operator
move_rob1_r7_6 
0
1
0 0 102 167
1
end_operator
begin_operator
move_rob1_r8 
0
1
0 0 14 178
1
end_operator
begin_operator
move_rob1_r80 
0
1
0 0 130 179
1
end_operator
begin_operator
move_rob1_r81 
0
1
0 0 130 180
1
end_operator
begin_operator
move_rob1_r82 
0
1
0 0 132 181
1
end_operator
begin_operator
move_rob1_r83 
0
1
0 0 123 182
1
end_operator
begin_operator
move_rob1_r84 
0
1
0 0 132 183
1
end_operator
begin_operator
move_rob1_r85 
0
1
0 0 1 184
1
end_operator
begin_operator
move_rob1_r86 
0
1
0 0 127 185
1
end_operator
begin_operator
move_rob1_r87 
0
1
0 0 112 186
1
end_operator
begin_operator
move_rob1_r88 
0
1
0 0 126 187
1
end_operator
begin_operator
move_rob1_r89 
0
1
0 0 129 188
1
end_operator
begin_operator
move_rob1_r8_2 
0
1
0 0 145 178
1
end_operator
begin_operator
move_rob1_r8_3 
0
1
0 0 152 178
1
end_operator
begin_operator
move_rob1_r8_4 
0
1
0 0 155 178
1
end_operator
begin_operator
move_rob1_r8_5 
0
1
0 0 194 178
1
end_operator
begin_operator
move_rob1_r9 
0
1
0 0 17 189
1
end_operator
begin_operator
move_rob1_r90 
0
1
0 0 130 190
1
end_operator
begin_operator
move_rob1_r91 
0
1
0 0 1 191
1
end_operator
begin_operator
move_rob1_r92 
0
1
0 0 120 192
1
end_operator
begin_operator
move_rob1_r93 
0
1
0 0 145 193
1
end_operator
begin_operator
move_rob1_r94 
0
1
0 0 178 194
1
end_operator
begin_operator
move_rob1_r95 
0
1
0 0 119 195
1
end_operator
begin_operator
move_rob1_r96 
0
1
0 0 118 196
1
end_operator
begin_operator
move_rob1_r97 
0
1
0 0 124 197
1
end_operator
begin_operator
move_rob1_r98 
0
1
0 0 68 198
1
end_operator
begin_operator
move_rob1_r99 
0
1
0 0 46 199
1
end_operator
begin_operator
move_rob1_r9_2 
0
1
0 0 90 189
1
end_operator
begin_operator
move_rob1_r9_3 
0
1
0 0 112 189
1
end_operator
begin_operator
move_rob1_r9_4 
0
1
0 0 122 189
1
end_operator
begin_operator
move_rob1_r9_5 
0
1
0 0 126 189
1
end_operator
begin_operator
move_rob1_r9_6 
0
1
0 0 143 189
1
end_operator
0
