// The plugin as a whole: what the worker is sent and what the artist is shown.
#include "support/mouse.h"
#include "support/studio_test.h"
#include "tool/panel/problem_card.h"

#include <QComboBox>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>

using namespace lampblack;

class StudioPreviewTest : public StudioTest
{
    Q_OBJECT

private Q_SLOTS:
    void lampThatIsNeverPickedCostsNothing()
    {
        mHost->mWindow.show();
        mHost->goToFrame(2);
        Q_EMIT mHost->drawingChanged(2);
        Q_EMIT mHost->viewChanged();
        QTest::qWait(20);
        QCOMPARE(mWorker->mStarted, 0);
        QVERIFY(mHost->mRequests.isEmpty());
        QVERIFY(mWorker->mPreviews.isEmpty());
    }

    void pickingTheLampShowsTheFrame()
    {
        mHost->open();
        QCOMPARE(mWorker->mStarted, 1);
        QCOMPARE(mWorker->mScenes.last(), defaultScene(mHost->canvasSize()));
        QCOMPARE(mHost->mRequests.size(), 3); // each layer, and both together
        QCOMPARE(mHost->mRequests[2].layers, (QStringList{QStringLiteral("Line"), QStringLiteral("Hills")}));
        QCOMPARE(mWorker->mPut, QVector<int>{1});
        QCOMPARE(mWorker->mPalettes, QVector<int>{1});
        QTRY_COMPARE(mWorker->mPreviews.size(), 1);
        QCOMPARE(mWorker->mPreviews[0].frame, 1);
        QCOMPARE(mWorker->mPreviews[0].show, Show::Lit);
        QVERIFY(!showsPicture() && showsStandIn());

        PreviewImage coarse = mWorker->pictureOf(1);
        coarse.converged = false;
        Q_EMIT mWorker->imageArrived(coarse);
        QVERIFY(showsPicture());
        QCOMPARE(mStudio->shownRevision(), mStudio->sentRevision());
        QVERIFY(!mStudio->isSettled());
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(1));
        QVERIFY(mStudio->isSettled());
    }

    void editIsSentOnce()
    {
        openLit();
        const int scenes = mWorker->mScenes.size();
        setPower(2.5);
        QCOMPARE(mWorker->mScenes.size(), scenes + 1);
        QCOMPARE(sentPower(), 2.5);
        QCOMPARE(mStudio->sentRevision(), mWorker->revision());
        QVERIFY(!mStudio->isSettled());
        setPower(2.5);
        QTest::qWait(20);
        QCOMPARE(mWorker->mScenes.size(), scenes + 1);
        QCOMPARE(mWorker->mPreviews.size(), 1); // the worker lights what it was asked for, again

        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(1));
        QVERIFY(mStudio->isSettled());
    }

    void burstOfViewsAsksForOnePicture()
    {
        openLit();
        for (int shift = 1; shift <= 10; ++shift)
            mHost->setView(QTransform::fromTranslate(-shift, 0));
        QTRY_COMPARE(mWorker->mPreviews.size(), 2);
        QTest::qWait(20);
        QCOMPARE(mWorker->mPreviews.size(), 2);
        QCOMPARE(mWorker->mPreviews[1].crop.left(), 10.0);
    }

    void newDrawingReplacesThePicture()
    {
        openLit();
        draw();
        QCOMPARE(mWorker->mPut, (QVector<int>{1, 1}));
        QCOMPARE(mWorker->mPalettes, (QVector<int>{1, 1}));
        QTRY_VERIFY(!showsPicture() && showsStandIn());
        QVERIFY(!mStudio->isSettled());
        mHost->goToFrame(2);
        mHost->goToFrame(1);
        QVERIFY2(!showsPicture(), "the picture of the old drawing is not kept");
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(1));
        QVERIFY(showsPicture() && mStudio->isSettled());
    }

    void drawingThatTheWorkerLacksIsSentAgain()
    {
        openLit();
        const int requests = mHost->mRequests.size();
        Q_EMIT mWorker->frameNeeded(3);
        QCOMPARE(mHost->mRequests.size(), requests + 3);
        QCOMPARE(mHost->mRequests.last().first, 3);
        QCOMPARE(mHost->mRequests.last().layers, mHost->mRequests[requests - 1].layers);
        QCOMPARE(mWorker->mPut, (QVector<int>{1, 3}));
    }

    void pictureOfAnotherFrameIsNotShown()
    {
        mHost->open();
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(2));
        QVERIFY(!showsPicture());
        QCOMPARE(mStudio->shownRevision(), 0ULL);
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(1));
        QVERIFY(showsPicture());
        mHost->goToFrame(2);
        QVERIFY(!showsPicture());
        QVERIFY(!mStudio->isSettled());
    }

    void pictureSeenBeforeReturnsWhileItIsCurrent()
    {
        openLit();
        mHost->goToFrame(2);
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(2));
        mHost->goToFrame(1);
        QVERIFY(showsPicture());
        setPower(2.5);
        mHost->goToFrame(2);
        QVERIFY2(!showsPicture(), "it shows the scene as it was");
        QVERIFY2(showsStandIn() && !isReady(), "in the new light");
    }

    void pictureOfAnotherViewIsNotShown()
    {
        openLit();
        find<QAbstractButton>("panel.view.normals")->click();
        QVERIFY(!showsPicture());
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(1));
        QVERIFY(!showsPicture());
        QTRY_COMPARE(mWorker->mPreviews.last().show, Show::Normals);
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(1, Show::Normals));
        QVERIFY(showsPicture());
    }

    void depthIsAskedForWhileItIsShown()
    {
        openLit();
        mWorker->mOverlaps.clear(); // asked for by the instant shading
        find<QAbstractButton>("panel.view.depth")->click();
        QVERIFY(find<QLabel>("panel.depth_help")->isVisible());
        QTRY_COMPARE(mWorker->mOverlaps, QVector<int>{1});
        QTRY_COMPARE(mWorker->mPreviews.last().show, Show::Relief);
        Overlap arm;
        arm.points = {{100, 50}, {200, 50}};
        Q_EMIT mWorker->overlapsArrived(2, {arm, arm});
        QVERIFY(mStudio->cutPlaces().isEmpty());
        Q_EMIT mWorker->overlapsArrived(1, {arm});
        QCOMPARE(mStudio->cutPlaces().size(), 1);

        setPower(2.5); // changes no depth
        QTest::qWait(20);
        QCOMPARE(mWorker->mOverlaps, QVector<int>{1});
        QTest::mouseClick(mHost->mCanvas, Qt::LeftButton, Qt::NoModifier, QPoint(150, 50));
        QCOMPARE(mWorker->mScenes.last().depth.hints.size(), 1);
        QTRY_COMPARE(mWorker->mOverlaps, (QVector<int>{1, 1}));
        Q_EMIT mHost->drawingChanged(1);
        QTRY_COMPARE(mWorker->mOverlaps.size(), 3);
        mHost->goToFrame(2);
        QTRY_COMPARE(mWorker->mOverlaps.last(), 2);

        const int asked = mWorker->mOverlaps.size();
        find<QAbstractButton>("panel.view.lit")->click();
        QVERIFY(!find<QLabel>("panel.depth_help")->isVisible());
        mHost->goToFrame(1);
        QTest::qWait(20);
        QCOMPARE(mWorker->mOverlaps.size(), asked);
    }

    void framesWithHintsThatCountHereAreSent()
    {
        mHost->open();
        QCOMPARE(mWorker->mPut, QVector<int>{1});
        find<QAbstractButton>("panel.view.depth")->click();
        mHost->goToFrame(4);
        const auto draw = [this](int y)
        {
            dragMouse(mHost->mCanvas, {{100.0, double(y)}, {150.0, double(y)}, {200.0, double(y)}});
        };
        draw(200);
        QVERIFY(find<QAbstractButton>("panel.view.lit"));
        find<QAbstractButton>("panel.view.lit")->click();
        mWorker->mPut.clear();
        // Another session: only the current frame has been sent.
        Q_EMIT mHost->layersChanged();
        QTRY_COMPARE(mWorker->mPut, QVector<int>{4});
        mHost->goToFrame(2);
        QTRY_COMPARE(mWorker->mPut, (QVector<int>{4, 2}));
        mWorker->mPut.clear();
        Q_EMIT mHost->layersChanged();
        QTRY_COMPARE(mWorker->mPut, (QVector<int>{2, 4}));
        QTest::qWait(20);
        QCOMPARE(mWorker->mPut.size(), 2);
    }

    void pictureWaitsForItsBackground()
    {
        mHost->open();
        mHost->mDraw = {};
        const QStringList lit{QStringLiteral("Line")};
        const QStringList background{QStringLiteral("Hills")};
        auto* role = find<QComboBox>("panel.layer.Hills");
        Q_EMIT role->activated(role->findData(QStringLiteral("background")));
        QCOMPARE(mWorker->mDropped, 1);
        QCOMPARE(mHost->mRequests.last().layers, lit);
        Q_EMIT mHost->frameExported({1, drawing(), {}, lit});
        QCOMPARE(mHost->mRequests.last().layers, background);
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(1));
        QVERIFY(!showsPicture());
        Q_EMIT mHost->frameExported({1, drawing(), {}, background});
        QVERIFY(showsPicture());
        QCOMPARE(mWorker->mPut, (QVector<int>{1, 1})); // the background stays with us
    }

    void lostWorkerIsReportedAndFollowedByTheNext()
    {
        openLit();
        auto* line = find<QLabel>("panel.worker");
        const QString ready = line->text();
        mWorker->setState(Worker::State::Restarting);
        QVERIFY(line->text() != ready);
        Q_EMIT mWorker->problem({QStringLiteral("It ended."), QStringLiteral("Wait."), {}});
        QVERIFY(!find<ProblemCard>("panel.problem")->isHidden());
        QCOMPARE(find<QLabel>("panel.problem.what")->text(), QStringLiteral("It ended."));
        QCOMPARE(find<QLabel>("panel.problem.remedy")->text(), QStringLiteral("Wait."));
        setPower(2.5);
        QCOMPARE(sentPower(), 2.5);

        mWorker->setState(Worker::State::Ready);
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(1));
        QCOMPARE(line->text(), ready);
        QVERIFY(showsPicture() && mStudio->isSettled());
    }

    void leavingTheLampStopsTheWork()
    {
        setKeepsLight(false);
        openLit();
        const int cancelled = mWorker->mPreviewsCancelled;
        mHost->mTool->setChecked(false);
        QCOMPARE(mHost->mCancelled, 1);
        QTRY_COMPARE(mWorker->mPreviewsCancelled, cancelled + 1);
        QVERIFY(!showsPicture());
        const int requests = mHost->mRequests.size();
        Q_EMIT mHost->drawingChanged(1);
        mHost->goToFrame(2);
        QCOMPARE(mHost->mRequests.size(), requests);
        QCOMPARE(mWorker->mStopped, 0);
    }

    void coloursOfAllFramesSeenAreListed()
    {
        const auto rows = [this]
        {
            QStringList colours;
            const auto found = mHost->mWindow.findChildren<QWidget*>(
                QRegularExpression(QStringLiteral("^lampblack\\.materials\\.row\\.#......$")));
            for (const QWidget* row : found)
                colours.append(row->objectName().right(7));
            colours.sort();
            return colours;
        };
        mHost->open();
        const QString red = QStringLiteral("#ff0000");
        const QString blue = QStringLiteral("#0000ff");
        Q_EMIT mWorker->paletteArrived(1, {{red, 10}});
        Q_EMIT mWorker->paletteArrived(2, {{QStringLiteral("#00ff00"), 10}}); // nobody looks at it
        QCOMPARE(rows(), QStringList{red});
        mHost->goToFrame(2);
        Q_EMIT mWorker->paletteArrived(2, {{blue, 20}});
        QCOMPARE(rows(), (QStringList{blue, red}));
        Q_EMIT mHost->projectOpened(mHost->mProject);
        Q_EMIT mWorker->paletteArrived(2, {{blue, 20}});
        QTRY_COMPARE(rows(), QStringList{blue});
    }

    void sceneIsSavedAndLoadedWithItsProject()
    {
        const QString project = mHost->mProject;
        const QString sidecar = SceneDocument::sidecarOf(project);
        Q_EMIT mHost->projectSaved(project);
        QVERIFY2(!QFile::exists(sidecar), "a project that was never lit gets no file");
        setPower(2.5);
        QVERIFY(!QFile::exists(sidecar));
        Q_EMIT mHost->projectSaved(project);
        QVERIFY(QFile::exists(sidecar));

        mHost->mProject = mFolder->filePath(QStringLiteral("run.pclx"));
        Q_EMIT mHost->projectOpened(mHost->mProject);
        QCOMPARE(mWorker->mScenes.last(), defaultScene(mHost->canvasSize()));
        mHost->mProject = project;
        Q_EMIT mHost->projectOpened(project);
        QCOMPARE(sentPower(), 2.5);
    }

    void unsavedLightIsAskedFor()
    {
        QVERIFY(mHost->mMayLeave());
        setPower(2.5);
        for (const auto button : {QMessageBox::Cancel, QMessageBox::Save})
        {
            QTimer::singleShot(0, mHost.get(),
                               [button]
                               {
                                   auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
                                   QVERIFY(box != nullptr);
                                   box->button(button)->click();
                               });
            QCOMPARE(mHost->mMayLeave(), button == QMessageBox::Save);
        }
        QVERIFY(QFile::exists(SceneDocument::sidecarOf(mHost->mProject)));
    }

    void closingEndsTheWorkerAndClearsTheWindow()
    {
        openLit();
        mStudio->close();
        QCOMPARE(mWorker->mStopped, 1);
        QVERIFY(mHost->mCanvas->findChildren<QWidget*>().isEmpty());
        QVERIFY(!mHost->mMayLeave);
        QVERIFY(!mStudio->isSettled());
        const int requests = mHost->mRequests.size();
        mHost->goToFrame(2);
        Q_EMIT mHost->drawingChanged(2);
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(2));
        QCOMPARE(mHost->mRequests.size(), requests);
    }
};

QTEST_MAIN(StudioPreviewTest)
#include "test_studio.moc"
