// The panel borrows height from the docks below it and gives it back.
#include "tool/panel/borrowed_height.h"

#include <QCloseEvent>
#include <QMainWindow>
#include <QScrollArea>
#include <QtTest>

using namespace lampblack;

class PanelHeightTest : public QObject
{
    Q_OBJECT

private:
    QMainWindow mWindow;
    QVector<QDockWidget*> mDocks;
    QScrollArea* mPage = nullptr;

    QVector<int> heights() const
    {
        QVector<int> all;
        for (const QDockWidget* dock : mDocks)
            all << dock->height();
        return all;
    }

private Q_SLOTS:
    void initTestCase()
    {
        mWindow.setCentralWidget(new QWidget);
        for (int place = 0; place < 4; ++place)
        {
            auto* dock = new QDockWidget(QStringLiteral("Dock %1").arg(place));
            dock->setObjectName(dock->windowTitle());
            auto* content = new QScrollArea;
            content->setWidget(new QWidget);
            dock->setWidget(content);
            mWindow.addDockWidget(Qt::LeftDockWidgetArea, dock);
            mDocks << dock;
            if (place == 1)
                mPage = content;
        }
        for (int place = 0; place < 2; ++place)
        {
            auto* beside = new QDockWidget(QStringLiteral("Beside %1").arg(place));
            beside->setWidget(new QScrollArea);
            mWindow.addDockWidget(Qt::RightDockWidgetArea, beside);
            mDocks << beside;
        }
        mWindow.resize(700, 760);
        mWindow.show();
        QVERIFY(QTest::qWaitForWindowExposed(&mWindow));
        mWindow.resizeDocks({mDocks[0], mDocks[1], mDocks[2], mDocks[3]}, {180, 160, 180, 230}, Qt::Vertical);
        QCoreApplication::processEvents();
    }

    void thoseBelowLendAndHaveItBack()
    {
        const QVector<int> before = heights();
        BorrowedHeight height;
        height.borrow(*mPage, 300);
        QCoreApplication::processEvents();
        QVERIFY(mDocks[1]->height() > before[1] + 100);
        QCOMPARE(mDocks[0]->height(), before[0]);
        QCOMPARE(mDocks[4]->height(), before[4]);
        height.giveBack();
        QCoreApplication::processEvents();
        QCOMPARE(heights(), before);
    }

    void noMoreIsTakenThanThereIs()
    {
        const QVector<int> before = heights();
        BorrowedHeight height;
        height.borrow(*mPage, 5000);
        QCoreApplication::processEvents();
        QCOMPARE(mDocks[0]->height(), before[0]);
        height.giveBack();
        QCoreApplication::processEvents();
        QCOMPARE(heights(), before);
    }

    void onALowWindowThoseBelowBecomeTabsAndComeBack()
    {
        for (QDockWidget* dock : {mDocks[0], mDocks[2], mDocks[3]})
            dock->widget()->setMinimumHeight(120);
        mWindow.resize(700, 600);
        QCoreApplication::processEvents();
        const QVector<int> before = heights();
        BorrowedHeight height;
        height.borrow(*mPage, 500);
        QCoreApplication::processEvents();
        QCOMPARE(mWindow.tabifiedDockWidgets(mDocks[1]).size(), 2);
        QVERIFY(!mPage->visibleRegion().isEmpty());
        QTRY_VERIFY(mDocks[1]->height() > before[1] + 150);
        mDocks[3]->close();
        height.giveBack();
        QCoreApplication::processEvents();
        QVERIFY(mWindow.tabifiedDockWidgets(mDocks[1]).isEmpty());
        QVERIFY(mDocks[2]->y() > mDocks[1]->y());
        QVERIFY2(mDocks[3]->isHidden(), "the artist closed it");
        mDocks[3]->show();
        QTRY_COMPARE(heights(), before);
        height.borrow(*mPage, 500);
        QCloseEvent closing;
        QCoreApplication::sendEvent(&mWindow, &closing);
        QVERIFY(mWindow.tabifiedDockWidgets(mDocks[1]).isEmpty());
        height.giveBack();
        for (QDockWidget* dock : {mDocks[0], mDocks[2], mDocks[3]})
            dock->widget()->setMinimumHeight(0);
        mWindow.resize(700, 760);
        mWindow.show();
    }

    /// Also on a machine that takes long from one turn of the event loop to the next.
    void aColumnThatDocksDoNotFillIsNotSeen()
    {
        mWindow.resize(700, 600);
        QCoreApplication::processEvents();
        for (QDockWidget* dock : {mDocks[0], mDocks[2], mDocks[3]})
            dock->widget()->setMinimumHeight(120);
        QCoreApplication::processEvents();
        BorrowedHeight height;
        height.borrow(*mPage, 500);
        QVERIFY2(mDocks[1]->geometry().bottom() > 500, "it is bare below the tabs");
        height.giveBack();
        QCoreApplication::processEvents();
        for (QDockWidget* dock : {mDocks[0], mDocks[2], mDocks[3]})
            dock->widget()->setMinimumHeight(0);
        mWindow.resize(700, 760);
    }

    void aFloatingDockIsLeftAlone()
    {
        mDocks[1]->setFloating(true);
        const QSize before = mDocks[1]->size();
        BorrowedHeight height;
        height.borrow(*mPage, 300);
        QCoreApplication::processEvents();
        QCOMPARE(mDocks[1]->size(), before);
        height.giveBack();
        mDocks[1]->setFloating(false);
    }
};

QTEST_MAIN(PanelHeightTest)
#include "test_panel_height.moc"
