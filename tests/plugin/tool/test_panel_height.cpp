// The panel borrows height from the docks below it and gives it back.
#include "tool/panel/borrowed_height.h"

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
