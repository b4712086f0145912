! A column that is pinned at both ends and buckles between two walls, as a boundary value problem of its left half, which
! ends at midspan or where it lies down on the wall. Inextensible elastica with bending stiffness PAR(6).
!
! U: x, z, slope, moment over the free length, which is scaled to 1.
! PAR(1) axial load, (2) force of the left support across the axis, (3) free length, (4) z and (5) moment at its end,
! (7) what the flat part lacks to buckle between its ends, clamped: its Euler load is pi**2 EI / (1 - length)**2.
!
! Which of the parameters are unknowns says in what contact the column is: see column.auto.
      SUBROUTINE FUNC(NDIM,U,ICP,PAR,IJAC,F,DFDU,DFDP)
      IMPLICIT NONE
      INTEGER, INTENT(IN) :: NDIM, ICP(*), IJAC
      DOUBLE PRECISION, INTENT(IN) :: U(NDIM), PAR(*)
      DOUBLE PRECISION, INTENT(OUT) :: F(NDIM)
      DOUBLE PRECISION, INTENT(INOUT) :: DFDU(NDIM,NDIM), DFDP(NDIM,*)
      F(1) = PAR(3)*COS(U(3))
      F(2) = PAR(3)*SIN(U(3))
      F(3) = PAR(3)*U(4)/PAR(6)
      F(4) = PAR(3)*(PAR(2)*COS(U(3)) - PAR(1)*SIN(U(3)))
      END SUBROUTINE FUNC

      SUBROUTINE STPNT(NDIM,U,PAR,T)
      IMPLICIT NONE
      INTEGER, INTENT(IN) :: NDIM
      DOUBLE PRECISION, INTENT(INOUT) :: U(NDIM), PAR(*)
      DOUBLE PRECISION, INTENT(IN) :: T
      DOUBLE PRECISION, PARAMETER :: PI = 3.14159265358979323846D0
      PAR(1:7) = 0D0
      PAR(1) = 0.2D0
      PAR(3) = 1D0
      PAR(6) = 0.175D0
      PAR(7) = -PI**2*PAR(6)
      U = 0D0
      U(1) = T
      END SUBROUTINE STPNT

      SUBROUTINE BCND(NDIM,PAR,ICP,NBC,U0,U1,FB,IJAC,DBC)
      IMPLICIT NONE
      INTEGER, INTENT(IN) :: NDIM, ICP(*), NBC, IJAC
      DOUBLE PRECISION, INTENT(IN) :: PAR(*), U0(NDIM), U1(NDIM)
      DOUBLE PRECISION, INTENT(OUT) :: FB(NBC)
      DOUBLE PRECISION, INTENT(INOUT) :: DBC(NBC,*)
      DOUBLE PRECISION, PARAMETER :: PI = 3.14159265358979323846D0
      FB(1) = U0(1)
      FB(2) = U0(2)
      FB(3) = U0(4)
      FB(4) = U1(3)
      FB(5) = U1(2) - PAR(4)
      FB(6) = U1(4) - PAR(5)
      FB(7) = PAR(7) - PAR(1)*(1D0 - PAR(3))**2 + PI**2*PAR(6)
      END SUBROUTINE BCND

      SUBROUTINE ICND
      END SUBROUTINE ICND
      SUBROUTINE FOPT
      END SUBROUTINE FOPT
      SUBROUTINE PVLS
      END SUBROUTINE PVLS
