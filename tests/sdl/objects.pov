// What the text asks about objects and pigments before the scene is complete. Lines that begin
// with @ must be POV-Ray's to the last digit.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "check.inc"
#declare S=sphere{<0.1,0.2,0>,1}
#declare B=box{-1,<1,0.5,0.7> rotate <10,20,30>}
#declare C=cylinder{-y,y,0.6}
#declare K=cone{-y,1,y,0.3 open}
#declare T=torus{1,0.3 rotate 30*x}
#declare D=disc{0,<0.2,1,0>,1,0.3}
#declare P=plane{y,-0.5}
#declare R=triangle{<-1,0,0>,<1,0,0.4>,<0,1,0>}
#declare U=union{sphere{-0.5*x,0.6} box{-0.4,0.4 translate 0.5*x}}
#declare I=intersection{sphere{0,1} box{-0.7,0.7}}
#declare F=difference{box{-1,1} sphere{0,1.2}}
#declare M=merge{sphere{-0.4*x,0.7} sphere{0.4*x,0.7}}
#declare X=sphere{0,1 clipped_by{plane{y,0.2}}}
#declare N=sphere{0,1 inverse}
#declare Q=plane{y,0 inverse}
#declare H=bicubic_patch{type 1 flatness 0.01 u_steps 3 v_steps 3 <-1,0,-1><-0.3,1,-1><0.3,-1,-1><1,0,-1> <-1,0.5,-0.3><-0.3,1,-0.3><0.3,0,-0.3><1,0,-0.3> <-1,0,0.3><-0.3,0.3,0.3><0.3,0,0.3><1,0.5,0.3> <-1,0,1><-0.3,1,1><0.3,-1,1><1,0,1>}
#declare G=union{object{H} sphere{0,0.3} no_image}
#declare V=box{-1,1 no_image no_shadow no_reflection}
#declare NN=<0,0,0>;
#declare Hit=trace(S,<0,3,0>,<0,-1,0>,NN);
#debug concat("@S0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Sn0 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Si0 ",str(inside(S,<0.0,1.0,0.0>),0,0),"\n")
#declare Hit=trace(S,<0,0,0>,<0,0,1>,NN);
#debug concat("@S1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Sn1 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Si1 ",str(inside(S,<0.0,0.0,0.0>),0,0),"\n")
#declare Hit=trace(S,<0,0,-4>,<0,0,2>,NN);
#debug concat("@S2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Sn2 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Si2 ",str(inside(S,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#declare Hit=trace(S,<-1.1025881699444484,2.0817268590427593,1.3286272581457088>,<0.5579549097173095,-1.606291672752832,-1.906599388707464>,NN);
#debug concat("@S3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Sn3 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Si3 ",str(inside(S,<-0.3675293899814828,0.6939089530142531,0.44287575271523627>),0,0),"\n")
#declare Hit=trace(S,<0.5872626023305831,-1.8665038372486515,-2.491125688987327>,<0.00698498922826829,1.4016340492408401,2.0358955597468986>,NN);
#debug concat("@S4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Sn4 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Si4 ",str(inside(S,<0.19575420077686104,-0.6221679457495505,-0.8303752296624424>),0,0),"\n")
#declare Hit=trace(S,<2.412105544129626,1.8620388271840094,-1.0534741612653675>,<-1.6737407618094926,-1.7992812769907123,1.3380029248663152>,NN);
#debug concat("@S5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Sn5 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Si5 ",str(inside(S,<0.8040351813765421,0.6206796090613365,-0.3511580537551225>),0,0),"\n")
#declare Hit=trace(S,<-1.476102427331036,2.2048800054399953,0.9532097055345412>,<2.222605327038549,-1.5748933213176297,-1.2751474689683528>,NN);
#debug concat("@S6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Sn6 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Si6 ",str(inside(S,<-0.49203414244367866,0.7349600018133318,0.3177365685115137>),0,0),"\n")
#declare Hit=trace(S,<-0.6940503263880793,-1.670219714351272,-1.7714904522965873>,<-0.0017261322108387267,1.3523942755824119,1.9364664481488343>,NN);
#debug concat("@S7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Sn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Si7 ",str(inside(S,<-0.23135010879602644,-0.5567399047837573,-0.5904968174321957>),0,0),"\n")
#debug concat("@Sb ",vstr(3,min_extent(S)," ",0,17),"\n")
#debug concat("@Sm ",vstr(3,max_extent(S)," ",0,17),"\n")
#declare Hit=trace(B,<0,3,0>,<0,-1,0>,NN);
#debug concat("@B0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Bn0 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Bi0 ",str(inside(B,<0.0,1.0,0.0>),0,0),"\n")
#declare Hit=trace(B,<0,0,0>,<0,0,1>,NN);
#debug concat("@B1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Bn1 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Bi1 ",str(inside(B,<0.0,0.0,0.0>),0,0),"\n")
#declare Hit=trace(B,<0,0,-4>,<0,0,2>,NN);
#debug concat("@B2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Bn2 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Bi2 ",str(inside(B,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#declare Hit=trace(B,<-2.2214638449605326,2.0803467422099544,-2.336393900153621>,<2.2111665624338643,-1.538859892340943,1.745308823598613>,NN);
#debug concat("@B3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Bn3 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Bi3 ",str(inside(B,<-0.7404879483201775,0.6934489140699848,-0.7787979667178737>),0,0),"\n")
#declare Hit=trace(B,<1.1583221168833822,2.248992813109494,0.6519964671319727>,<-0.697506837234811,-2.8783838375938795,-0.7567081621712732>,NN);
#debug concat("@B4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Bn4 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Bi4 ",str(inside(B,<0.38610737229446074,0.7496642710364979,0.21733215571065756>),0,0),"\n")
#declare Hit=trace(B,<-1.753773277298711,1.7236694850268144,-1.0259353689401447>,<1.6788211388986727,-0.9247895681156655,1.5895396423701333>,NN);
#debug concat("@B5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Bn5 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Bi5 ",str(inside(B,<-0.5845910924329036,0.5745564950089381,-0.3419784563133816>),0,0),"\n")
#declare Hit=trace(B,<2.3800378487331546,-0.2323000520418832,-0.05920500722382105>,<-2.012829817106188,0.1987679722741259,-0.275158805341019>,NN);
#debug concat("@B6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Bn6 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Bi6 ",str(inside(B,<0.7933459495777182,-0.07743335068062773,-0.01973500240794035>),0,0),"\n")
#declare Hit=trace(B,<-0.48105292387826504,-1.7674681874900928,-0.6149962610730904>,<1.2624732445292222,2.5031736010628363,0.8181402146008327>,NN);
#debug concat("@B7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Bn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Bi7 ",str(inside(B,<-0.16035097462608836,-0.5891560624966976,-0.20499875369103013>),0,0),"\n")
#debug concat("@Bb ",vstr(3,min_extent(B)," ",0,17),"\n")
#debug concat("@Bm ",vstr(3,max_extent(B)," ",0,17),"\n")
#debug concat("@Ci0 ",str(inside(C,<0.0,1.0,0.0>),0,0),"\n")
#debug concat("@Ci1 ",str(inside(C,<0.0,0.0,0.0>),0,0),"\n")
#debug concat("@Ci2 ",str(inside(C,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#debug concat("@Ci3 ",str(inside(C,<-0.09821930746148262,0.25019510563143516,-0.4682697261497733>),0,0),"\n")
#debug concat("@Ci4 ",str(inside(C,<-0.04735749240020981,-0.45626234057365006,-0.7430949820601711>),0,0),"\n")
#debug concat("@Ci5 ",str(inside(C,<-0.511066497013957,-0.7739040824834286,-0.05778306038305366>),0,0),"\n")
#debug concat("@Ci6 ",str(inside(C,<-0.43692265056054763,0.6719705384722715,-0.8322323070153548>),0,0),"\n")
#debug concat("@Ci7 ",str(inside(C,<-0.6415426024688365,0.5522834329213081,-0.21020057344969775>),0,0),"\n")
#debug concat("@Cb ",vstr(3,min_extent(C)," ",0,17),"\n")
#debug concat("@Cm ",vstr(3,max_extent(C)," ",0,17),"\n")
#debug concat("@Ki0 ",str(inside(K,<0.0,1.0,0.0>),0,0),"\n")
#debug concat("@Ki1 ",str(inside(K,<0.0,0.0,0.0>),0,0),"\n")
#debug concat("@Ki2 ",str(inside(K,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#debug concat("@Ki3 ",str(inside(K,<0.24146104682834935,0.17308954001292332,0.4057887307679004>),0,0),"\n")
#debug concat("@Ki4 ",str(inside(K,<0.05582986657852048,-0.2731305905484717,-0.33862972344860465>),0,0),"\n")
#debug concat("@Ki5 ",str(inside(K,<0.4083619740187867,0.1513411617835314,-0.7726184775079771>),0,0),"\n")
#debug concat("@Ki6 ",str(inside(K,<0.6465676263896206,0.07598714519514764,-0.809065806000549>),0,0),"\n")
#debug concat("@Ki7 ",str(inside(K,<0.3469686949410516,0.22039224268079347,-0.03020156350368171>),0,0),"\n")
#debug concat("@Kb ",vstr(3,min_extent(K)," ",0,17),"\n")
#debug concat("@Km ",vstr(3,max_extent(K)," ",0,17),"\n")
#debug concat("@Ti0 ",str(inside(T,<0.0,1.0,0.0>),0,0),"\n")
#debug concat("@Ti1 ",str(inside(T,<0.0,0.0,0.0>),0,0),"\n")
#debug concat("@Ti2 ",str(inside(T,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#debug concat("@Ti3 ",str(inside(T,<-0.5814846534449832,0.21890988794400235,0.009740172453678456>),0,0),"\n")
#debug concat("@Ti4 ",str(inside(T,<-0.3945887950163816,0.08612549845914404,-0.4096829042756567>),0,0),"\n")
#debug concat("@Ti5 ",str(inside(T,<-0.44263281097632373,-0.21464312507040528,0.39458815491328164>),0,0),"\n")
#debug concat("@Ti6 ",str(inside(T,<-0.6912610732860177,0.27992202634545915,-0.6813695422884711>),0,0),"\n")
#debug concat("@Ti7 ",str(inside(T,<0.6282110818057699,-0.03255344972882993,-0.29452293977670574>),0,0),"\n")
#debug concat("@Tb ",vstr(3,min_extent(T)," ",0,17),"\n")
#debug concat("@Tm ",vstr(3,max_extent(T)," ",0,17),"\n")
#debug concat("@Db ",vstr(3,min_extent(D)," ",0,17),"\n")
#debug concat("@Dm ",vstr(3,max_extent(D)," ",0,17),"\n")
#declare Hit=trace(P,<0,3,0>,<0,-1,0>,NN);
#debug concat("@P0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Pn0 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Pi0 ",str(inside(P,<0.0,1.0,0.0>),0,0),"\n")
#declare Hit=trace(P,<0,0,0>,<0,0,1>,NN);
#debug concat("@P1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Pn1 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Pi1 ",str(inside(P,<0.0,0.0,0.0>),0,0),"\n")
#declare Hit=trace(P,<0,0,-4>,<0,0,2>,NN);
#debug concat("@P2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Pn2 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Pi2 ",str(inside(P,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#declare Hit=trace(P,<1.003011958628019,-2.259844440832649,-1.5007302986017939>,<-1.3453826608630064,2.05786471887556,0.8583798522807263>,NN);
#debug concat("@P3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Pn3 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Pi3 ",str(inside(P,<0.33433731954267304,-0.7532814802775496,-0.5002434328672646>),0,0),"\n")
#declare Hit=trace(P,<-0.3971101056986699,-0.9303526066294165,1.2615860167615862>,<0.4868447672786995,1.56409657566348,-1.0150290320947737>,NN);
#debug concat("@P4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Pn4 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Pi4 ",str(inside(P,<-0.13237003523288995,-0.31011753554313887,0.4205286722538621>),0,0),"\n")
#declare Hit=trace(P,<1.298593548370273,0.3736446435868359,-0.2890869921642727>,<-0.7917124461948482,-0.12491093495078731,1.0167103239341464>,NN);
#debug concat("@P5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Pn5 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Pi5 ",str(inside(P,<0.43286451612342436,0.12454821452894531,-0.09636233072142424>),0,0),"\n")
#declare Hit=trace(P,<1.1401009204684573,1.0058836425690094,-1.1615256925472173>,<-0.6407793070940468,-1.194035150400454,0.5699169455569907>,NN);
#debug concat("@P6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Pn6 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Pi6 ",str(inside(P,<0.38003364015615243,0.33529454752300314,-0.3871752308490724>),0,0),"\n")
#declare Hit=trace(P,<-2.170355606584078,-1.6531862267356319,-1.1870399304584078>,<2.451790146417311,1.310020138083447,0.4886774553301121>,NN);
#debug concat("@P7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Pn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Pi7 ",str(inside(P,<-0.7234518688613593,-0.5510620755785439,-0.39567997681946926>),0,0),"\n")
#debug concat("@Pb ",vstr(3,min_extent(P)," ",0,17),"\n")
#debug concat("@Pm ",vstr(3,max_extent(P)," ",0,17),"\n")
#declare Hit=trace(R,<0,3,0>,<0,-1,0>,NN);
#debug concat("@R0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Rn0 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(R,<0,0,0>,<0,0,1>,NN);
#debug concat("@R1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Rn1 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(R,<0,0,-4>,<0,0,2>,NN);
#debug concat("@R2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Rn2 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(R,<1.6583950533840088,-0.049434960574920694,-2.3112799564834967>,<-2.1871053662631996,-0.5926129244423713,2.6595867945363394>,NN);
#debug concat("@R3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Rn3 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(R,<2.0009084388939353,-1.5034149290445376,1.4851839749161706>,<-2.282411657578723,1.7960606036325752,-0.9041929626556697>,NN);
#debug concat("@R4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Rn4 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(R,<0.6155169044101845,1.5018532871820724,-0.6178232770908809>,<-1.3993855021139,-1.4830632971702362,0.7565060909849485>,NN);
#debug concat("@R5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Rn5 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(R,<-1.5763021702594155,-0.5545287943550385,-0.9137785554703544>,<0.8195810743426815,0.25385256194069067,0.7263173879105627>,NN);
#debug concat("@R6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Rn6 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(R,<-0.11948728763852268,1.0167348269600591,-0.5044766347948548>,<0.8913071031265567,-0.5118896776887989,1.182698038569631>,NN);
#debug concat("@R7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Rn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Rb ",vstr(3,min_extent(R)," ",0,17),"\n")
#debug concat("@Rm ",vstr(3,max_extent(R)," ",0,17),"\n")
#declare Hit=trace(U,<0,3,0>,<0,-1,0>,NN);
#debug concat("@U0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Un0 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ui0 ",str(inside(U,<0.0,1.0,0.0>),0,0),"\n")
#declare Hit=trace(U,<0,0,0>,<0,0,1>,NN);
#debug concat("@U1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Un1 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ui1 ",str(inside(U,<0.0,0.0,0.0>),0,0),"\n")
#declare Hit=trace(U,<0,0,-4>,<0,0,2>,NN);
#debug concat("@U2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Un2 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ui2 ",str(inside(U,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#declare Hit=trace(U,<1.6513497993324275,1.8929237330675193,1.1401764827601468>,<-1.7843914406778982,-2.0122953799100576,-1.0941449409808317>,NN);
#debug concat("@U3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Un3 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ui3 ",str(inside(U,<0.5504499331108091,0.6309745776891731,0.3800588275867156>),0,0),"\n")
#declare Hit=trace(U,<2.0236666591594323,-0.9883829795467043,-1.0962567074438696>,<-1.8550772115489191,1.7348868968915132,0.5958313618062518>,NN);
#debug concat("@U4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Un4 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ui4 ",str(inside(U,<0.6745555530531441,-0.32946099318223476,-0.3654189024812899>),0,0),"\n")
#declare Hit=trace(U,<-2.3476057444076783,-1.9220183679589686,0.31287627499605986>,<2.513122699823599,1.416222727416808,-0.8084232557817117>,NN);
#debug concat("@U5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Un5 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ui5 ",str(inside(U,<-0.7825352481358928,-0.6406727893196562,0.10429209166535329>),0,0),"\n")
#declare Hit=trace(U,<0.4726057910290873,0.7317930008005917,0.951127049704815>,<-0.10632810733939779,-1.4335656077420276,-0.9756119566439894>,NN);
#debug concat("@U6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Un6 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ui6 ",str(inside(U,<0.15753526367636242,0.2439310002668639,0.317042349901605>),0,0),"\n")
#declare Hit=trace(U,<1.673170608257247,2.28605080667099,-0.9077685255795276>,<-1.112630427240463,-2.0537606771986208,1.5905100710409237>,NN);
#debug concat("@U7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Un7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ui7 ",str(inside(U,<0.557723536085749,0.7620169355569967,-0.3025895085265092>),0,0),"\n")
#debug concat("@Ub ",vstr(3,min_extent(U)," ",0,17),"\n")
#debug concat("@Um ",vstr(3,max_extent(U)," ",0,17),"\n")
#declare Hit=trace(I,<0,3,0>,<0,-1,0>,NN);
#debug concat("@I0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@In0 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ii0 ",str(inside(I,<0.0,1.0,0.0>),0,0),"\n")
#declare Hit=trace(I,<0,0,0>,<0,0,1>,NN);
#debug concat("@I1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@In1 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ii1 ",str(inside(I,<0.0,0.0,0.0>),0,0),"\n")
#declare Hit=trace(I,<0,0,-4>,<0,0,2>,NN);
#debug concat("@I2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@In2 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ii2 ",str(inside(I,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#declare Hit=trace(I,<-1.31081267181562,0.8309782192121382,-2.1331216713102834>,<0.9444770052481646,-1.4773462512700508,2.09721301319259>,NN);
#debug concat("@I3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@In3 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ii3 ",str(inside(I,<-0.4369375572718733,0.2769927397373794,-0.7110405571034278>),0,0),"\n")
#declare Hit=trace(I,<2.4232072450187587,0.20679853274814697,-0.5685667374922136>,<-1.7289478131198408,-0.8598865843954885,0.33779786772283626>,NN);
#debug concat("@I4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@In4 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ii4 ",str(inside(I,<0.8077357483395863,0.06893284424938233,-0.18952224583073787>),0,0),"\n")
#declare Hit=trace(I,<1.5539002077141753,-2.474382824526002,1.329553356051853>,<-1.7762302437508535,1.7006354163898143,-1.7281874135458974>,NN);
#debug concat("@I5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@In5 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ii5 ",str(inside(I,<0.5179667359047251,-0.8247942748420006,0.44318445201728435>),0,0),"\n")
#declare Hit=trace(I,<-0.20884543818352075,-0.5859107945803292,0.08384105110205109>,<-0.5061518418000743,0.1356492874725691,0.67504292349155>,NN);
#debug concat("@I6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@In6 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ii6 ",str(inside(I,<-0.06961514606117358,-0.1953035981934431,0.02794701703401703>),0,0),"\n")
#declare Hit=trace(I,<-0.28678569897273354,-0.14055428954925642,-2.073258572961773>,<-0.06655768531289108,0.8681603219109906,2.3725633261503267>,NN);
#debug concat("@I7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@In7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ii7 ",str(inside(I,<-0.09559523299091117,-0.04685142984975214,-0.6910861909872578>),0,0),"\n")
#debug concat("@Ib ",vstr(3,min_extent(I)," ",0,17),"\n")
#debug concat("@Im ",vstr(3,max_extent(I)," ",0,17),"\n")
#declare Hit=trace(F,<0,3,0>,<0,-1,0>,NN);
#debug concat("@F0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Fn0 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Fi0 ",str(inside(F,<0.0,1.0,0.0>),0,0),"\n")
#declare Hit=trace(F,<0,0,0>,<0,0,1>,NN);
#debug concat("@F1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Fn1 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Fi1 ",str(inside(F,<0.0,0.0,0.0>),0,0),"\n")
#declare Hit=trace(F,<0,0,-4>,<0,0,2>,NN);
#debug concat("@F2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Fn2 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Fi2 ",str(inside(F,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#declare Hit=trace(F,<0.7175418883348779,-0.6250558680449003,-0.6565108930156682>,<-0.7532495462971236,0.7557787894564526,1.4018767376324637>,NN);
#debug concat("@F3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Fn3 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Fi3 ",str(inside(F,<0.2391806294449593,-0.20835195601496678,-0.21883696433855607>),0,0),"\n")
#declare Hit=trace(F,<-1.2954222051418167,0.34335434960079114,-1.184692009630679>,<1.3679917662970242,0.026964091614416263,0.5984495393367104>,NN);
#debug concat("@F4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Fn4 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Fi4 ",str(inside(F,<-0.4318074017139389,0.11445144986693039,-0.3948973365435597>),0,0),"\n")
#declare Hit=trace(F,<-0.09423588719112308,1.0287939032874882,-2.4592948699290034>,<0.5280457780731664,-1.1586288743288968,2.465955745204177>,NN);
#debug concat("@F5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Fn5 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Fi5 ",str(inside(F,<-0.03141196239704103,0.3429313010958294,-0.8197649566430011>),0,0),"\n")
#declare Hit=trace(F,<0.552523219437504,1.4644736165822132,-2.219702496961065>,<-0.5516457050927929,-2.2032088430673653,2.0364841713953035>,NN);
#debug concat("@F6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Fn6 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Fi6 ",str(inside(F,<0.18417440647916802,0.4881578721940711,-0.739900832320355>),0,0),"\n")
#declare Hit=trace(F,<-0.7712326654598167,-2.393010088884881,-1.0112781658924335>,<0.6912704965581521,2.6408132896474026,1.6909459475574724>,NN);
#debug concat("@F7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Fn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Fi7 ",str(inside(F,<-0.25707755515327224,-0.7976700296282937,-0.33709272196414447>),0,0),"\n")
#debug concat("@Fb ",vstr(3,min_extent(F)," ",0,17),"\n")
#debug concat("@Fm ",vstr(3,max_extent(F)," ",0,17),"\n")
#declare Hit=trace(M,<0,3,0>,<0,-1,0>,NN);
#debug concat("@M0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Mn0 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Mi0 ",str(inside(M,<0.0,1.0,0.0>),0,0),"\n")
#declare Hit=trace(M,<0,0,0>,<0,0,1>,NN);
#debug concat("@M1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Mn1 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Mi1 ",str(inside(M,<0.0,0.0,0.0>),0,0),"\n")
#declare Hit=trace(M,<0,0,-4>,<0,0,2>,NN);
#debug concat("@M2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Mn2 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Mi2 ",str(inside(M,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#declare Hit=trace(M,<2.2451062759809117,-1.9448752438360777,-2.179795141547748>,<-1.9506287942378244,1.2933643142817934,1.4867306154165063>,NN);
#debug concat("@M3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Mn3 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Mi3 ",str(inside(M,<0.748368758660304,-0.6482917479453593,-0.7265983805159161>),0,0),"\n")
#declare Hit=trace(M,<-0.19853575885879238,0.7443656595241723,1.9603463091369484>,<0.5519197033592893,-1.4333923376520565,-1.7313575701258026>,NN);
#debug concat("@M4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Mn4 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Mi4 ",str(inside(M,<-0.06617858628626412,0.24812188650805744,0.6534487697123161>),0,0),"\n")
#declare Hit=trace(M,<1.7181535167007524,-1.8973821250670824,1.2724961454162247>,<-2.104310725937017,1.5752103094220469,-2.070097608271379>,NN);
#debug concat("@M5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Mn5 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Mi5 ",str(inside(M,<0.5727178389002509,-0.6324607083556941,0.42416538180540825>),0,0),"\n")
#declare Hit=trace(M,<1.2910588205902211,0.07876461958875547,2.0098333991333055>,<-1.3462085023866743,-0.6300906243801252,-2.463588122880083>,NN);
#debug concat("@M6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Mn6 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Mi6 ",str(inside(M,<0.43035294019674036,0.026254873196251822,0.6699444663777685>),0,0),"\n")
#declare Hit=trace(M,<-1.1832023667310536,2.2338681895924655,-1.4737660267346286>,<0.5243273561239216,-2.469490071151025,0.8003532464485508>,NN);
#debug concat("@M7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Mn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Mi7 ",str(inside(M,<-0.3944007889103512,0.7446227298641551,-0.4912553422448762>),0,0),"\n")
#debug concat("@Mb ",vstr(3,min_extent(M)," ",0,17),"\n")
#debug concat("@Mm ",vstr(3,max_extent(M)," ",0,17),"\n")
#declare Hit=trace(X,<0,3,0>,<0,-1,0>,NN);
#debug concat("@X0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Xn0 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Xi0 ",str(inside(X,<0.0,1.0,0.0>),0,0),"\n")
#declare Hit=trace(X,<0,0,0>,<0,0,1>,NN);
#debug concat("@X1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Xn1 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Xi1 ",str(inside(X,<0.0,0.0,0.0>),0,0),"\n")
#declare Hit=trace(X,<0,0,-4>,<0,0,2>,NN);
#debug concat("@X2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Xn2 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Xi2 ",str(inside(X,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#declare Hit=trace(X,<0.32486455668302217,-1.0501045118443142,-1.9607217728483883>,<-0.30635851464010777,1.7431853109730213,2.6742894121489864>,NN);
#debug concat("@X3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Xn3 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Xi3 ",str(inside(X,<0.10828818556100739,-0.3500348372814381,-0.6535739242827961>),0,0),"\n")
#declare Hit=trace(X,<-0.16939009054467213,-1.9862437929896082,1.343540111409136>,<-0.4469242417611414,2.0460851527845376,-2.0096137120029787>,NN);
#debug concat("@X4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Xn4 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Xi4 ",str(inside(X,<-0.05646336351489071,-0.6620812643298694,0.44784670380304537>),0,0),"\n")
#declare Hit=trace(X,<2.436126197270326,0.2136254079855453,-0.3126181991817467>,<-2.8006369563086024,-0.13213082087527783,1.0693272124155213>,NN);
#debug concat("@X5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Xn5 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Xi5 ",str(inside(X,<0.8120420657567754,0.0712084693285151,-0.10420606639391557>),0,0),"\n")
#declare Hit=trace(X,<-0.360632723601376,-1.4537279351826897,0.07329430361777423>,<1.0298109130420288,1.264555698934024,0.1408729835037006>,NN);
#debug concat("@X6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Xn6 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Xi6 ",str(inside(X,<-0.12021090786712534,-0.4845759783942299,0.024431434539258074>),0,0),"\n")
#declare Hit=trace(X,<2.0936545056077707,-0.8715730577153502,1.5544435646954717>,<-2.0472356114220043,0.2947375959336861,-2.2687159462873074>,NN);
#debug concat("@X7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Xn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Xi7 ",str(inside(X,<0.6978848352025903,-0.2905243525717834,0.5181478548984906>),0,0),"\n")
#debug concat("@Xb ",vstr(3,min_extent(X)," ",0,17),"\n")
#debug concat("@Xm ",vstr(3,max_extent(X)," ",0,17),"\n")
#declare Hit=trace(N,<0,3,0>,<0,-1,0>,NN);
#debug concat("@N0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Nn0 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ni0 ",str(inside(N,<0.0,1.0,0.0>),0,0),"\n")
#declare Hit=trace(N,<0,0,0>,<0,0,1>,NN);
#debug concat("@N1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Nn1 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ni1 ",str(inside(N,<0.0,0.0,0.0>),0,0),"\n")
#declare Hit=trace(N,<0,0,-4>,<0,0,2>,NN);
#debug concat("@N2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Nn2 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ni2 ",str(inside(N,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#declare Hit=trace(N,<1.159178559639284,0.025764753216712233,1.0578029114450604>,<-0.9761768770111633,0.4478635175787371,-1.6029082784270132>,NN);
#debug concat("@N3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Nn3 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ni3 ",str(inside(N,<0.3863928532130947,0.00858825107223741,0.3526009704816868>),0,0),"\n")
#declare Hit=trace(N,<-0.027299163789947123,-2.4939457126324567,1.4540623308251455>,<0.46170908574239244,3.033301638826434,-2.184986362233341>,NN);
#debug concat("@N4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Nn4 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ni4 ",str(inside(N,<-0.009099721263315708,-0.8313152375441523,0.48468744360838184>),0,0),"\n")
#declare Hit=trace(N,<0.17616957433791303,-0.10702327000807443,-1.9025206663875738>,<-0.6520511130987494,0.8659919829443306,2.466743473166746>,NN);
#debug concat("@N5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Nn5 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ni5 ",str(inside(N,<0.05872319144597101,-0.03567442333602481,-0.6341735554625246>),0,0),"\n")
#declare Hit=trace(N,<-1.3091153403399358,1.6456046104211461,0.754962939851886>,<1.124960846741482,-1.4140332357255745,-1.1885523310166946>,NN);
#debug concat("@N6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Nn6 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ni6 ",str(inside(N,<-0.43637178011331196,0.548534870140382,0.251654313283962>),0,0),"\n")
#declare Hit=trace(N,<-1.1312087282503773,-2.449544697812826,0.7832291437639234>,<1.261462723513248,2.8390031744875026,-0.7771760015362376>,NN);
#debug concat("@N7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Nn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Ni7 ",str(inside(N,<-0.3770695760834591,-0.816514899270942,0.2610763812546411>),0,0),"\n")
#debug concat("@Nb ",vstr(3,min_extent(N)," ",0,17),"\n")
#debug concat("@Nm ",vstr(3,max_extent(N)," ",0,17),"\n")
#declare Hit=trace(Q,<0,3,0>,<0,-1,0>,NN);
#debug concat("@Q0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Qn0 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Qi0 ",str(inside(Q,<0.0,1.0,0.0>),0,0),"\n")
#declare Hit=trace(Q,<0,0,0>,<0,0,1>,NN);
#debug concat("@Q1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Qn1 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Qi1 ",str(inside(Q,<0.0,0.0,0.0>),0,0),"\n")
#declare Hit=trace(Q,<0,0,-4>,<0,0,2>,NN);
#debug concat("@Q2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Qn2 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Qi2 ",str(inside(Q,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#declare Hit=trace(Q,<1.8536609497920349,2.0857412897998824,1.4652102370747944>,<-1.9879131305595732,-1.830129132219798,-1.2119999242230841>,NN);
#debug concat("@Q3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Qn3 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Qi3 ",str(inside(Q,<0.6178869832640116,0.6952470965999608,0.4884034123582648>),0,0),"\n")
#declare Hit=trace(Q,<1.9136102805153135,1.068004657890608,-0.28295417380972854>,<-2.4084051713647248,-1.3440635632293167,-0.11648380545860904>,NN);
#debug concat("@Q4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Qn4 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Qi4 ",str(inside(Q,<0.6378700935051045,0.35600155263020267,-0.09431805793657617>),0,0),"\n")
#declare Hit=trace(Q,<0.9095533142591301,1.346965433886914,-1.539596027837466>,<-0.8559963120734918,-0.8025267718213234,1.3246029638305097>,NN);
#debug concat("@Q5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Qn5 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Qi5 ",str(inside(Q,<0.3031844380863767,0.4489884779623046,-0.513198675945822>),0,0),"\n")
#declare Hit=trace(Q,<-2.0264635343639963,0.528010742105522,-0.6880354577514769>,<1.4566492413047047,-0.8671759148955772,-0.10094531779327898>,NN);
#debug concat("@Q6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Qn6 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Qi6 ",str(inside(Q,<-0.6754878447879987,0.17600358070184066,-0.22934515258382562>),0,0),"\n")
#declare Hit=trace(Q,<-1.7555885126655213,-0.3733134661562243,-1.9753243869978887>,<0.965194477099042,0.45326401893692103,2.7077325747289027>,NN);
#debug concat("@Q7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Qn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Qi7 ",str(inside(Q,<-0.5851961708885071,-0.12443782205207476,-0.6584414623326296>),0,0),"\n")
#debug concat("@Qb ",vstr(3,min_extent(Q)," ",0,17),"\n")
#debug concat("@Qm ",vstr(3,max_extent(Q)," ",0,17),"\n")
#declare Hit=trace(H,<0,3,0>,<0,-1,0>,NN);
#debug concat("@H0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Hn0 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(H,<0,0,0>,<0,0,1>,NN);
#debug concat("@H1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Hn1 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(H,<0,0,-4>,<0,0,2>,NN);
#debug concat("@H2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Hn2 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(H,<-0.7876510966255741,-1.4549178124892475,0.9090770447230163>,<0.7262412575320366,0.8122007708799726,-0.3294355059059364>,NN);
#debug concat("@H3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Hn3 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(H,<-0.8594971882021152,0.9303483354187492,-0.23584322257418755>,<1.4542499639992506,-1.6372909342989495,-0.19922948687342967>,NN);
#debug concat("@H4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Hn4 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(H,<-1.0718763131833193,-1.1783017419306152,1.6099464479658554>,<1.0757451854202824,0.9330962026244723,-1.5989659480603267>,NN);
#debug concat("@H5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Hn5 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(H,<1.729028169454427,0.34868649701473586,-0.24278404515333252>,<-1.4780829328152683,-0.16454026287696255,0.09156335316385011>,NN);
#debug concat("@H6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Hn6 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(H,<-0.36839283540817913,-1.8415001011145526,-0.3046288593573916>,<0.9746807563355988,1.531119890073901,0.08896508559469674>,NN);
#debug concat("@H7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Hn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Hb ",vstr(3,min_extent(H)," ",0,17),"\n")
#debug concat("@Hm ",vstr(3,max_extent(H)," ",0,17),"\n")
#declare Hit=trace(G,<0,3,0>,<0,-1,0>,NN);
#debug concat("@G0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Gn0 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(G,<0,0,0>,<0,0,1>,NN);
#debug concat("@G1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Gn1 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(G,<0,0,-4>,<0,0,2>,NN);
#debug concat("@G2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Gn2 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(G,<1.3931579721909007,-0.9678742625106822,-0.806339854865779>,<-1.2143064231897505,0.4275960047474284,1.5009916494499715>,NN);
#debug concat("@G3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Gn3 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(G,<-2.2728601770036616,-0.002387947102451271,-1.1332323970120166>,<2.314552436373612,-0.7246443338048114,0.6919921697006565>,NN);
#debug concat("@G4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Gn4 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(G,<2.445228149373385,1.4402404172137162,-1.3948609915326926>,<-2.515550436254479,-2.1882837314478554,0.7900819597672762>,NN);
#debug concat("@G5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Gn5 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(G,<-1.5408123244099758,2.4214561541952504,-0.9410449445407458>,<1.137142036073287,-3.1169491056556153,0.3168559345430024>,NN);
#debug concat("@G6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Gn6 ",vstr(3,NN," ",0,17),"\n")
#declare Hit=trace(G,<2.4767010619955094,1.200964919644477,2.1017244056542204>,<-1.939592779536926,-0.7487291334784565,-2.493717696903426>,NN);
#debug concat("@G7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Gn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Gb ",vstr(3,min_extent(G)," ",0,17),"\n")
#debug concat("@Gm ",vstr(3,max_extent(G)," ",0,17),"\n")
#declare Hit=trace(V,<0,3,0>,<0,-1,0>,NN);
#debug concat("@V0 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Vn0 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Vi0 ",str(inside(V,<0.0,1.0,0.0>),0,0),"\n")
#declare Hit=trace(V,<0,0,0>,<0,0,1>,NN);
#debug concat("@V1 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Vn1 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Vi1 ",str(inside(V,<0.0,0.0,0.0>),0,0),"\n")
#declare Hit=trace(V,<0,0,-4>,<0,0,2>,NN);
#debug concat("@V2 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Vn2 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Vi2 ",str(inside(V,<0.0,0.0,-1.3333333333333333>),0,0),"\n")
#declare Hit=trace(V,<-0.1712064146772252,0.22625396587138757,-2.0241154105861003>,<0.5579214887375208,-0.47172484056693975,1.984353377897632>,NN);
#debug concat("@V3 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Vn3 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Vi3 ",str(inside(V,<-0.0570688048924084,0.07541798862379585,-0.6747051368620335>),0,0),"\n")
#declare Hit=trace(V,<0.10994221983863017,1.6940070321542873,-0.9893963480821533>,<-0.014319010776801866,-1.5252763659980704,1.2380203723138514>,NN);
#debug concat("@V4 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Vn4 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Vi4 ",str(inside(V,<0.03664740661287672,0.5646690107180957,-0.3297987826940511>),0,0),"\n")
#declare Hit=trace(V,<-0.9389830984567031,-1.104501603612652,-0.14799327209772217>,<1.1006264677218507,1.335980596756694,-0.4379504483147767>,NN);
#debug concat("@V5 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Vn5 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Vi5 ",str(inside(V,<-0.31299436615223436,-0.36816720120421736,-0.04933109069924072>),0,0),"\n")
#declare Hit=trace(V,<-0.2693266217400807,0.30133737739055144,-1.5262907839753814>,<-0.3671858889094636,0.38497758502424717,0.7595756497528315>,NN);
#debug concat("@V6 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Vn6 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Vi6 ",str(inside(V,<-0.0897755405800269,0.10044579246351715,-0.5087635946584604>),0,0),"\n")
#declare Hit=trace(V,<-0.0067435882736592845,-1.026648895953794,-2.3444773927895812>,<-0.36137415287463226,0.4849459969409693,2.184777461964271>,NN);
#debug concat("@V7 ",vstr(3,Hit," ",0,17),"\n")
#debug concat("@Vn7 ",vstr(3,NN," ",0,17),"\n")
#debug concat("@Vi7 ",str(inside(V,<-0.0022478627578864283,-0.3422162986512647,-0.7814924642631937>),0,0),"\n")
#debug concat("@Vb ",vstr(3,min_extent(V)," ",0,17),"\n")
#debug concat("@Vm ",vstr(3,max_extent(V)," ",0,17),"\n")
#debug concat("@w0 ",vstr(3,vturbulence(2.8791129066143495,0.4430029215758593,9,<2.2221580278927444,2.6525983073809325,-0.31857755175439895>)," ",0,17),"\n")
#debug concat("@w1 ",vstr(3,vturbulence(1.4407628619125565,0.14678553554742646,1,<-2.613747344050452,-2.6362938192655405,2.1055034334967253>)," ",0,17),"\n")
#debug concat("@w2 ",vstr(3,vturbulence(2.5791395010272895,0.8599623790032562,2,<2.77187320932946,1.518597488718287,0.397182602486847>)," ",0,17),"\n")
#debug concat("@w3 ",vstr(3,vturbulence(1.2805617743499773,0.11185974480890859,0,<-4.862804376591049,1.9795972567386162,1.7941530569524202>)," ",0,17),"\n")
#debug concat("@w4 ",vstr(3,vturbulence(2.8267936733912675,0.9460858190014476,12,<3.2841916949673546,-4.35429685993908,-0.7366516857514789>)," ",0,17),"\n")
#debug concat("@w5 ",vstr(3,vturbulence(2.9792484293502732,0.5198151069691366,12,<-4.794555877624276,2.8851151294874384,-0.6420091143473163>)," ",0,17),"\n")
#debug concat("@w6 ",vstr(3,vturbulence(1.9870797919075285,0.4935062888839352,10,<3.652522961778251,2.142019065022513,4.704651248738701>)," ",0,17),"\n")
#include "functions.inc"
#declare PF=function{pigment{bozo color_map{[0 rgb <1,0.5,0>][0.5 rgbft <0,0,1,0.2,0.3>][1 rgb 1]} turbulence 0.3 scale 0.7 rotate 30}}
#declare TF=function{pattern{marble turbulence 0.4 scale 2}}
#declare CF=function{pattern{checker}}
#declare AF=function{pigment{checker rgb 1 rgb <1,0,0.3> translate 0.3}}
#declare WF=function{PF(x,y,z).red*2+TF(x,y,z)-PF(z,y,x).transmit+AF(x,y,z).gray}
#declare GF=function{pattern{wood sine_wave frequency 2.5 phase 0.3}}
#declare Pig=pigment{granite}
#debug concat("@p0 ",vstr(5,PF(-1.5717945706142944,2.9819366413759507,0.7276422853563869)," ",0,9),"\n")
#debug concat("@q0 ",str(TF(-1.5717945706142944,2.9819366413759507,0.7276422853563869),0,17)," ",str(CF(-1.5717945706142944,2.9819366413759507,0.7276422853563869),0,17)," ",str(WF(-1.5717945706142944,2.9819366413759507,0.7276422853563869),0,17),"\n")
#debug concat("@g0 ",str(GF(-1.5717945706142944,2.9819366413759507,0.7276422853563869),0,17),"\n")
#debug concat("@e0 ",vstr(5,eval_pigment(Pig,<-1.5717945706142944,2.9819366413759507,0.7276422853563869>)," ",0,9),"\n")
#debug concat("@p1 ",vstr(5,PF(0.14178689682664736,1.0397566112507546,1.0330998066253798)," ",0,9),"\n")
#debug concat("@q1 ",str(TF(0.14178689682664736,1.0397566112507546,1.0330998066253798),0,17)," ",str(CF(0.14178689682664736,1.0397566112507546,1.0330998066253798),0,17)," ",str(WF(0.14178689682664736,1.0397566112507546,1.0330998066253798),0,17),"\n")
#debug concat("@g1 ",str(GF(0.14178689682664736,1.0397566112507546,1.0330998066253798),0,17),"\n")
#debug concat("@e1 ",vstr(5,eval_pigment(Pig,<0.14178689682664736,1.0397566112507546,1.0330998066253798>)," ",0,9),"\n")
#debug concat("@p2 ",vstr(5,PF(0.12780969683903898,-0.7996825485577208,-2.1155489663449227)," ",0,9),"\n")
#debug concat("@q2 ",str(TF(0.12780969683903898,-0.7996825485577208,-2.1155489663449227),0,17)," ",str(CF(0.12780969683903898,-0.7996825485577208,-2.1155489663449227),0,17)," ",str(WF(0.12780969683903898,-0.7996825485577208,-2.1155489663449227),0,17),"\n")
#debug concat("@g2 ",str(GF(0.12780969683903898,-0.7996825485577208,-2.1155489663449227),0,17),"\n")
#debug concat("@e2 ",vstr(5,eval_pigment(Pig,<0.12780969683903898,-0.7996825485577208,-2.1155489663449227>)," ",0,9),"\n")
#debug concat("@p3 ",vstr(5,PF(-2.823350875500167,-2.2743844709874246,-0.5683234596231821)," ",0,9),"\n")
#debug concat("@q3 ",str(TF(-2.823350875500167,-2.2743844709874246,-0.5683234596231821),0,17)," ",str(CF(-2.823350875500167,-2.2743844709874246,-0.5683234596231821),0,17)," ",str(WF(-2.823350875500167,-2.2743844709874246,-0.5683234596231821),0,17),"\n")
#debug concat("@g3 ",str(GF(-2.823350875500167,-2.2743844709874246,-0.5683234596231821),0,17),"\n")
#debug concat("@e3 ",vstr(5,eval_pigment(Pig,<-2.823350875500167,-2.2743844709874246,-0.5683234596231821>)," ",0,9),"\n")
#debug concat("@p4 ",vstr(5,PF(-2.93867804287846,1.0476765394973375,-0.9764515059773036)," ",0,9),"\n")
#debug concat("@q4 ",str(TF(-2.93867804287846,1.0476765394973375,-0.9764515059773036),0,17)," ",str(CF(-2.93867804287846,1.0476765394973375,-0.9764515059773036),0,17)," ",str(WF(-2.93867804287846,1.0476765394973375,-0.9764515059773036),0,17),"\n")
#debug concat("@g4 ",str(GF(-2.93867804287846,1.0476765394973375,-0.9764515059773036),0,17),"\n")
#debug concat("@e4 ",vstr(5,eval_pigment(Pig,<-2.93867804287846,1.0476765394973375,-0.9764515059773036>)," ",0,9),"\n")
#debug concat("@p5 ",vstr(5,PF(-1.5986439184493237,-1.1181300175431053,-0.04305413698909977)," ",0,9),"\n")
#debug concat("@q5 ",str(TF(-1.5986439184493237,-1.1181300175431053,-0.04305413698909977),0,17)," ",str(CF(-1.5986439184493237,-1.1181300175431053,-0.04305413698909977),0,17)," ",str(WF(-1.5986439184493237,-1.1181300175431053,-0.04305413698909977),0,17),"\n")
#debug concat("@g5 ",str(GF(-1.5986439184493237,-1.1181300175431053,-0.04305413698909977),0,17),"\n")
#debug concat("@e5 ",vstr(5,eval_pigment(Pig,<-1.5986439184493237,-1.1181300175431053,-0.04305413698909977>)," ",0,9),"\n")
#debug concat("@p6 ",vstr(5,PF(-1.7425350296451452,2.1142597714656546,-0.10239228964770275)," ",0,9),"\n")
#debug concat("@q6 ",str(TF(-1.7425350296451452,2.1142597714656546,-0.10239228964770275),0,17)," ",str(CF(-1.7425350296451452,2.1142597714656546,-0.10239228964770275),0,17)," ",str(WF(-1.7425350296451452,2.1142597714656546,-0.10239228964770275),0,17),"\n")
#debug concat("@g6 ",str(GF(-1.7425350296451452,2.1142597714656546,-0.10239228964770275),0,17),"\n")
#debug concat("@e6 ",vstr(5,eval_pigment(Pig,<-1.7425350296451452,2.1142597714656546,-0.10239228964770275>)," ",0,9),"\n")
CheckV("cylinder", trace(C, <0.5, 3, 0>, -y), <0.5, 1, 0>)
CheckV("cone", trace(K, <0, 0, -3>, z), <0, 0, -0.65>)
CheckV("torus", trace(T, <0, 5, 0>, <0, -1, 0>), <0, 0, 0>)
CheckV("no hit: no normal", trace(S, <0, 5, 0>, y, NN) + NN, <0, 0, 0>)
#declare Table = array[2] { <1, 1, 1>, <1, 1, 1> }
#declare Hit = trace(B, -5*z, z, Table[1]);
CheckV("the normal into an element", Table[0], <1, 1, 1>)
#if (vlength(Table[1] - <1, 1, 1>) < 0.1) #error "the element is unchanged" #end
#macro Drop(Where, Normal) (trace(P, Where, -y, Normal)) #end
CheckV("and through a parameter", Drop(<2, 3, 4>, NN) + NN, <2, 0.5, 4>)
sphere { 0, 1 }
